"""What the checks of `./run lint quick` refuse and allow: lint_checks_test.py SOURCE_DIR"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOLS = pathlib.Path(sys.argv.pop()) / "tools"
MODULES = "frangia_module(core)\nfrangia_module(phase USES core\n  LIBS a PRIVATE_LIBS b)\n"


class Tree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.write("CMakeLists.txt", MODULES)
        self.write("src/frangia/core/run.h", "#pragma once\n")
        self.write("src/frangia/phase/wrap.cpp", '#include "frangia/core/run.h"\n')

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def answer(self, tool, *arguments):
        done = subprocess.run([sys.executable, TOOLS / tool, *arguments], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr


class Layers(Tree):
    def check(self):
        return self.answer("check_layers.py", self.root)

    def test_allow_what_is_stated(self):
        self.assertEqual(self.check()[0], 0)

    def test_refuse_a_module_that_is_not_stated(self):
        self.write("src/frangia/core/run.cpp", '#include "frangia/phase/wrap.h"\n')
        code, text = self.check()
        self.assertEqual(code, 1)
        self.assertIn("run.cpp:1: core does not state that it uses phase", text)

    def test_keep_an_internal_header_of_a_subfolder_below_that_subfolder(self):
        self.write("src/frangia/phase/gray/deep/read.cpp", '#include "frangia/phase/gray/internal/lines.h"\n')
        self.assertEqual(self.check()[0], 0)
        self.write("src/frangia/phase/wrap/wrap.cpp", '#include "frangia/phase/gray/internal/lines.h"\n')
        code, text = self.check()
        self.assertEqual(code, 1)
        self.assertIn("an internal header of phase/gray is included outside of phase/gray", text)

    def test_allow_internal_headers_of_the_module_in_its_subfolders(self):
        self.write("src/frangia/phase/gray/read.cpp", '#include "frangia/phase/internal/lines.h"\n')
        self.assertEqual(self.check()[0], 0)

    def test_refuse_internal_headers_in_programs_and_bindings(self):
        for name in ("apps/frangia/main.cpp", "python/bindings/bind.cpp", "examples/own/main.cpp"):
            path = self.write(name, '#include "frangia/phase/gray/internal/lines.h"\n')
            code, text = self.check()
            self.assertEqual(code, 1, name)
            self.assertIn("public headers only", text)
            path.unlink()


class TypeNames(Tree):
    def check(self, *texts):
        files = [self.write(f"{number}.h", text) for number, text in enumerate(texts)]
        return self.answer("check_type_names.py", *files)

    def test_refuse_two_types_of_one_name_in_one_namespace(self):
        code, text = self.check(
            "namespace frangia {\nstruct Settings {\n  int a;\n};\n}",
            "namespace frangia {\n\nclass [[nodiscard]] Settings final : public std::exception {};\n}",
        )
        self.assertEqual(code, 1)
        self.assertRegex(text, r"frangia::Settings is defined in \S+0\.h:2 and \S+1\.h:3: rename one")

    def test_refuse_two_enums_of_one_name(self):
        one = "namespace a::b { enum class Side : int { left, right }; }"
        self.assertEqual(self.check(one, one)[0], 1)

    def test_allow_the_same_name_in_other_scopes(self):
        code, text = self.check(
            "namespace a { struct Limits { int x; }; }",
            "namespace b { struct Limits { int x; }; }",
            "namespace a { struct Fit { struct Limits { int x; }; }; }",
            "namespace a { namespace { struct Limits { int x; }; } }",
        )
        self.assertEqual((code, text), (0, ""))

    def test_allow_declarations_comments_and_specializations(self):
        code, text = self.check(
            "namespace a { struct Limits { char brace = '{'; const char* text = \"}{\"; }; }",
            "namespace a { struct Limits; struct Limits* make(); // struct Limits {\n/* struct Limits { */ }",
            "namespace a { template <> struct Limits<int> { int x; }; struct Limits variable() { return {}; } }",
        )
        self.assertEqual((code, text), (0, ""))


class InternalHeaders(Tree):
    def count(self):
        return self.answer("count_internal_headers.py", self.root, "--list")[1]

    def test_count_headers_with_fewer_than_two_users(self):
        self.write("src/frangia/phase/internal/lines.h", "#pragma once\n")
        use = '#include "frangia/phase/internal/lines.h"\n'
        self.write("src/frangia/phase/internal/lines.cpp", use)  # its own source is no user
        self.write("src/frangia/phase/gray.cpp", use)
        self.assertIn("frangia/phase/internal/lines.h\n1 of 1 internal headers have fewer than two users", self.count())
        self.write("tests/phase/lines_test.cpp", use)
        self.assertEqual(self.count(), "0 of 1 internal headers have fewer than two users\n")


class Length(Tree):
    def test_refuse_a_file_above_400_lines(self):
        fits, long = self.write("a.cpp", "\n" * 400), self.write("b.cpp", "\n" * 401)
        self.assertEqual(self.answer("check_length.py", fits)[0], 0)
        code, text = self.answer("check_length.py", fits, long)
        self.assertEqual(code, 1)
        self.assertIn("b.cpp (401)", text)
        self.assertNotIn("a.cpp", text)


class Promises(Tree):
    """The sections that the check asks for, with one promise each."""

    def pages(self, promise):
        self.write("tests/CMakeLists.txt", "add_test(NAME app.story)\n")
        self.write("tests/faults/kills.py", "")
        self.write("tests/core/run_test.cpp", "TEST(RunOfAll, Ends) {\n")
        sections = ["Light and motion", "A scan folder", "The app", "Files from elsewhere"]
        kept = "".join(f"## {name}\n\n- It holds (study `kills`).\n\n" for name in sections)
        self.write("docs/reliability.md", f"{kept}## Work and memory\n\n- {promise}\n")
        sections = [
            "Who may ask",
            "From other machines",
            "Revisions and versions",
            "Live state",
            "A project on the disk",
        ]
        self.write("docs/service-api.md", "".join(f"## {name}\n\nYes (`app.story`).\n\n" for name in sections))
        return self.answer("check_promises.py", self.root)

    def test_allow_what_names_its_test(self):
        self.assertEqual(self.pages("All ends (`RunOfAll`)."), (0, "\n"))

    def test_refuse_what_names_none(self):
        code, text = self.pages("All ends.")
        self.assertEqual(code, 1)
        self.assertIn("docs/reliability.md: no test is named for: - All ends.", text)

    def test_refuse_a_test_that_is_not_there(self):
        code, text = self.pages("All ends (`RunOfAll`, `RunOfNothing`).")
        self.assertEqual(code, 1)
        self.assertIn("there is no test 'RunOfNothing'", text)


class Faults(Tree):
    def rows(self, source, *rows):
        self.write("src/frangia/scan/scan.cpp", source)
        self.write("web/src/messages/faults_scan.ts", "export const ROWS = {\n%s};\n" % "".join(rows))
        return self.answer("check_faults.py", self.root)

    def test_find_a_sentence_that_a_source_breaks_over_lines(self):
        source = 'run.warn(fmt::format("view {} of \\"{}\\" is "\n    "dark by {:.2g} %", a, b, c));\n'
        row = "  'fault.dark': [\n    'view {0} of \"{1}\" is dark by {2} %',\n    'dunkel',\n    'scuro',\n  ],\n"
        self.assertEqual(self.rows(source, row), (0, ""))

    def test_refuse_a_row_whose_sentence_no_source_has(self):
        code, text = self.rows(
            'run.warn("it is dark here");\n', "  'fault.dark': ['it is bright here', 'hell', 'chiaro'],\n"
        )
        self.assertEqual(code, 1)
        self.assertIn("fault.dark: no source holds the sentence 'it is bright here'", text)

    def reached(self, source, *english):
        self.write("src/frangia/service/service.cpp", '#include "frangia/scan/scan.h"\nrun.note("all is well here");\n')
        self.write("src/frangia/scan/scan.h", "#pragma once\n")
        for name, text in english:
            self.write(name, text)
        row = "  'fault.well': ['all is well here', 'alles ist gut', 'tutto bene'],\n"
        return self.rows('#include "frangia/scan/scan.h"\n' + source, row)

    def test_refuse_a_sentence_without_a_row(self):
        code, text = self.reached('fail(path + ": the view " + name + " is dark");\n')
        self.assertEqual(code, 1)
        self.assertIn("frangia/scan/scan.cpp: web/src/messages has no row of '{0}: the view {1} is dark'", text)

    def test_refuse_a_sentence_within_a_choice(self):
        code, text = self.reached('fail(fmt::format("{}: {}", path, dark ? "it is too dark" : "it is too bright"));\n')
        self.assertEqual(code, 1)
        self.assertIn("has no row of 'it is too dark'", text)
        self.assertIn("has no row of 'it is too bright'", text)

    def test_allow_errors_of_a_program(self):
        self.assertEqual(self.reached('require(n > 0, "the count must be positive");\n'), (0, ""))

    def test_allow_what_the_service_does_not_reach(self):
        other = "src/frangia/print/print.cpp"
        self.assertEqual(self.reached("", (other, 'fail("this paper is too small");\n')), (0, ""))

    def test_allow_what_is_listed_with_a_reason_as_long_as_it_is_there(self):
        listed = "tools/english_sentences.toml"
        source = 'fail("the view is dark");\n'
        self.assertEqual(self.reached(source, (listed, '[unseen]\n"scan/scan" = "of the program"\n')), (0, ""))
        self.assertEqual(self.reached(source, (listed, '[single]\n"the view is dark" = "of a file"\n')), (0, ""))
        code, text = self.reached("", (listed, '[unseen]\n"scan/gone" = "of the program"\n'))
        self.assertEqual(code, 1)
        self.assertIn("lists 'scan/gone', which is no source", text)


class WebImports(Tree):
    def check(self, names, **sources):
        self.write("web/src/step_names.ts", f"export const STEP_NAMES = [{names}] as const;\n")
        self.write("web/src/steps/rig/index.ts", "import { store } from '../../store';\n")
        for name, text in sources.items():
            self.write(f"web/src/{name}.ts", text)
        return self.answer("check_web_imports.py", self.root)

    def test_allow_a_store_at_the_bottom(self):
        self.assertEqual(self.check("'rig'", store="export const store = 1;\n"), (0, ""))

    def test_refuse_a_circle_also_of_types(self):
        step = "import type { Step } from './steps/rig';\nexport const store = 1;\n"
        code, text = self.check("'rig'", store=step)
        self.assertEqual(code, 1)
        self.assertIn("a circle of imports: steps/rig/index.ts -> store.ts -> steps/rig/index.ts", text)

    def test_refuse_a_step_without_folder_and_a_folder_without_name(self):
        code, text = self.check("'scan'", store="export const store = 1;\n")
        self.assertEqual(code, 1)
        self.assertIn("the step rig has no name in STEP_NAMES", text)
        self.assertIn("the step scan has no folder of steps", text)


class SchemaTypes(Tree):
    def types(self, **definitions):
        schema = self.write("schema.json", json.dumps({"definitions": definitions}))
        self.assertEqual(self.answer("schema_types.py", schema, self.root / "schema.ts"), (0, ""))
        return (self.root / "schema.ts").read_text().split("\n\n", 1)[1]

    def test_write_an_object_with_what_it_may_lack(self):
        number = {"type": ["integer", "null"], "description": "Of the version."}
        one = {"type": "object", "required": ["at"], "properties": {"at": number, "by": {"enum": ["a", "b"]}}}
        lines = '  /** Of the version. */\n  at: number | null;\n  by?: "a" | "b";\n'
        self.assertEqual(self.types(kept_rig=one), "export type KeptRig = {\n" + lines + "};\n")

    def test_write_tuples_lists_and_references(self):
        pair = {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}
        many = {"type": "array", "items": {"anyOf": [{"$ref": "#/definitions/pair"}, {"type": "null"}]}}
        text = self.types(pair=pair, many=many)
        self.assertEqual(text, "export type Pair = [number, number];\n\nexport type Many = (Pair | null)[];\n")


if __name__ == "__main__":
    unittest.main()
