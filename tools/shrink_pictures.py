"""Reduces the PNGs of folders to 256 colours, for pictures of programs in the documentation: shrink_pictures.py FOLDER..."""
import pathlib
import sys

from PIL import Image

for folder in sys.argv[1:]:
    for path in sorted(pathlib.Path(folder).glob("*.png")):
        picture = Image.open(path).convert("RGB")
        picture.quantize(256, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.FLOYDSTEINBERG).save(
            path, optimize=True
        )
