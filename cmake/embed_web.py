"""Builds the front end, and writes a C++ source that holds its files.

    embed_web.py build WEB TREE NODE SCHEMA   type-checks and bundles WEB with the packages in TREE, into TREE/dist; SCHEMA gives
                                              the types of its messages
    embed_web.py embed DIST OUTPUT.cpp        compresses the files of DIST and includes them by the assembler
"""
import gzip
import pathlib
import shutil
import subprocess
import sys

TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
    ".woff2": "font/woff2",
    ".json": "application/json",
    ".png": "image/png",
}


def build(web: pathlib.Path, tree: pathlib.Path, node: str, schema: pathlib.Path) -> None:
    """The bundler looks for packages beside the sources, so that they are copied beside the packages."""
    for name in ("index.html", "vite.config.ts", "tsconfig.json"):
        shutil.copy(web / name, tree / name)
    for name in ("src", "public"):
        shutil.rmtree(tree / name, ignore_errors=True)
        if (web / name).exists():
            shutil.copytree(web / name, tree / name)
    writer = pathlib.Path(__file__).parent.parent / "tools/schema_types.py"
    subprocess.run([sys.executable, writer, schema, tree / "src/schema.ts"], check=True)
    modules = tree / "node_modules"
    for script in (
        [modules / "typescript/bin/tsc", "--noEmit"],
        [modules / "vite/bin/vite.js", "build", "--logLevel", "warn"],
    ):
        done = subprocess.run([node, *map(str, script)], cwd=tree, check=False)
        if done.returncode != 0:
            sys.exit(done.returncode)


def embed(dist: pathlib.Path, output: pathlib.Path) -> None:
    files = sorted(path for path in dist.rglob("*") if path.is_file())
    packed = output.parent / "web_assets"
    shutil.rmtree(packed, ignore_errors=True)
    packed.mkdir(parents=True)
    text = ['#include "web_assets.h"', "", "#include <array>", ""]
    entries = []
    for number, path in enumerate(files):
        compressed = packed / f"{number}.gz"
        compressed.write_bytes(gzip.compress(path.read_bytes(), 9, mtime=0))
        name = f"frangia_web_asset_{number}"
        text += [
            f'asm(".pushsection .rodata\\n{name}:\\n.incbin \\"{compressed}\\"\\n{name}_end:\\n.byte 0\\n'
            '.popsection\\n");',
            f'extern "C" const char {name}[];',
            f'extern "C" const char {name}_end[];',
        ]
        kind = TYPES.get(path.suffix, "application/octet-stream")
        entries.append(
            f'      {{"/{path.relative_to(dist)}", "{kind}", '
            f"{{{name}, static_cast<std::size_t>({name}_end - {name})}}}},"
        )
    text += [
        "",
        "namespace frangia {",
        "",
        "std::span<const WebAsset> web_assets() {",
        f"  static const std::array<WebAsset, {len(files)}> kAssets{{{{",
        *entries,
        "  }};",
        "  return kAssets;",
        "}",
        "",
        "}  // namespace frangia",
        "",
    ]
    output.write_text("\n".join(text))


if __name__ == "__main__":
    if sys.argv[1] == "build":
        build(pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]), sys.argv[4], pathlib.Path(sys.argv[5]))
    else:
        embed(pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]))
