"""Reduces the PNGs of folders to 256 colours, for pictures of programs in the documentation: shrink_pictures.py FOLDER...

Most colours are those of large areas; the others are far from each other, so that a lamp or the ends of a scale keep theirs.
"""
import pathlib
import sys

from PIL import Image

OF_AREAS = 160
OF_SIGNS = 96


def colours(picture, count, method):
    palette = picture.quantize(count, method=method).getpalette()[: 3 * count]
    return palette + palette[:3] * (count - len(palette) // 3)


for folder in sys.argv[1:]:
    for path in sorted(pathlib.Path(folder).glob("*.png")):
        picture = Image.open(path).convert("RGB")
        palette = Image.new("P", (1, 1))
        areas = colours(picture, OF_AREAS, Image.Quantize.MEDIANCUT)
        palette.putpalette(areas + colours(picture, OF_SIGNS, Image.Quantize.MAXCOVERAGE))
        picture.quantize(palette=palette, dither=Image.Dither.NONE).save(path, optimize=True)
