"""Which places of a source `./run lint mutants` changes, and what it leaves: mutants_test.py SOURCE_DIR"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(sys.argv[1]) / "tools/mutants"))
import sites  # noqa: E402 (below the path)


def changed(text):
    """The lines that the changes of a text make, without indentation."""
    return [
        (text[: site.start] + choice + text[site.end :]).strip()
        for site in sites.sites("a.cpp", text)
        for choice in site.choices
    ]


def check(text, expected):
    found = changed(text)
    assert found == expected, f"{text}\nexpected {expected}\n   found {found}"


# Operators, each by its counterpart.
check("sum = a + b;", ["sum = a - b;"])
check("sum = a * b / c;", ["sum = a / b / c;", "sum = a * b * c;"])
check("all += size;", ["all -= size;"])
check("if (a < b && !c) return;", ["if (a > b && !c) return;", "if (a < b || !c) return;", "if (a < b && c) return;"])
check(
    "if (a == b ||\n    c >= d)",
    ["if (a != b ||\n    c >= d)", "if (a == b &&\n    c >= d)", "if (a == b ||\n    c <= d)"],
)
check("return -x;", ["return x;"])
check("f(-x, a - b)", ["f(x, a - b)", "f(-x, a + b)"])
check("const bool on = true;", ["const bool on = false;"])

# Constants: one more or less; zero or ten times.
check("x = 4.0 * y;", ["x = 0.0 * y;", "x = 40.0 * y;", "x = 4.0 / y;"])
check("n = 0;", ["n = 1;"])
check("n = 3u;", ["n = 4u;", "n = 2u;"])
check("n = 1'000;", ["n = 1001;", "n = 999;"])
check("x = 0.0F;", ["x = 1.0F;"])
check("x = 1e-12;", [])  # keeps a divisor from zero

# What stays: types, declarations, comments, directives, literals, values in messages, capacities, progress.
for text in [
    "std::vector<Eigen::Matrix<double, 3, 1>> points;",
    "const float* p; int& r = *q; T&& t;",
    "auto&& [a, b] = c;",
    "x = y;  // 1 + 2",
    "/* 1 +\n 2 */",
    "#define TWO 2",
    '#include "a_1.h"',
    'text = "1 + 2";',
    "c = '1';",
    'text = R"(1 + 2 "3")";',
    'fail("{} of {}", i + 1, n);',
    "static_assert(2 > 1);",
    "points.reserve(3 * n);",
    "run.report((i + 1.0) / n);",
    "using A = B<3>;",
    "p->x;",
    "Vector3d v2;",
    "constexpr std::size_t kVerticesPerChunk = 4096;",
    "parts((mesh.triangles.size() + kChunk - 1) / kChunk);",
    "parallel_chunks(rows.size(), 64, work);",
    "i++;",
    "const auto f = [&](int x) {};",
]:
    check(text, [])
check(
    'require(n > 2, "of {} pixels", n + 1);',
    ['require(n < 2, "of {} pixels", n + 1);'] + [f'require(n > {n}, "of {{}} pixels", n + 1);' for n in (3, 1)],
)
check("a = b[1];\n// 5\n", ["a = b[2];\n// 5", "a = b[0];\n// 5"])
