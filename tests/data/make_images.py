#!/usr/bin/env python3
"""Writes small images in many formats by other programs (OpenCV's codecs, Pillow where it is installed, NumPy), for the
tests of the image readers and as seeds of the fuzzer:

    tests/data/make_images.py tests/data/images fuzz/seeds

Pixel (x, y) of the grey image is 20 x + 7 y + 3 of 8 bits, and 257 times that of 16 bits. The colour image has this in
red, 255 minus it in green, and 5 y in blue.
"""
import sys
from pathlib import Path

import cv2
import numpy as np

WIDTH, HEIGHT = 11, 6


def main():
    out, seeds = Path(sys.argv[1]), Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
    grey = (20 * x + 7 * y + 3).astype(np.uint8)
    wide = grey.astype(np.uint16) * 257
    color = np.dstack([5 * y, 255 - grey, grey]).astype(np.uint8)  # blue, green, red
    real = grey.astype(np.float32) / 255

    def save(name, image, *options):
        assert cv2.imwrite(str(out / name), image, list(options))

    for name, image in {"grey8": grey, "grey16": wide, "color8": color}.items():
        save(f"{name}.png", image)
        save(f"{name}.tiff", image)
    save("color16.png", color.astype(np.uint16) * 257)
    save("alpha8.png", np.dstack([color, 99 + 0 * grey]))
    save("float.tiff", real)
    save("raw.tiff", grey, cv2.IMWRITE_TIFF_COMPRESSION, 1)
    save("deflate.tiff", wide, cv2.IMWRITE_TIFF_COMPRESSION, 32946)
    assert cv2.imwritemulti(str(out / "pages.tiff"), [grey, 255 - grey, grey // 2])
    save("grey8.bmp", grey)
    save("color8.bmp", color)
    save("grey.jpg", cv2.resize(grey, (33, 18), interpolation=cv2.INTER_LINEAR), cv2.IMWRITE_JPEG_QUALITY, 85)
    save("color.jpg", cv2.resize(color, (33, 18), interpolation=cv2.INTER_LINEAR), cv2.IMWRITE_JPEG_QUALITY, 60)
    save("progressive.jpg", cv2.resize(grey, (33, 18)), cv2.IMWRITE_JPEG_QUALITY, 95, cv2.IMWRITE_JPEG_PROGRESSIVE, 1)
    save("grey8.pgm", grey)
    save("text.pgm", grey, cv2.IMWRITE_PXM_BINARY, 0)
    save("grey16.pgm", wide)
    save("color8.ppm", color)
    # OpenCV writes no PGM of 12 bits.
    twelve = (wide >> 4).astype(">u2")
    (out / "grey12.pgm").write_bytes(b"P5\n# 12 bits\n%d %d\n4095\n" % (WIDTH, HEIGHT) + twelve.tobytes())
    (out / "grey12be.raw").write_bytes(twelve.tobytes())
    np.save(out / "grey8.npy", grey)
    np.save(out / "stack16.npy", np.array([wide, 65535 - wide]))
    np.save(out / "int64.npy", grey.astype(np.int64))
    np.save(out / "float64.npy", real.astype(">f8"))
    np.save(out / "color.npy", color[:, :, ::-1])

    for folder, names in {
        "bmp": ["grey8.bmp", "color8.bmp"],
        "image": ["color16.png", "alpha8.png", "color8.png"],
        "jpeg": ["grey.jpg", "color.jpg", "progressive.jpg"],
        "npy": ["stack16.npy", "int64.npy", "float64.npy", "color.npy"],
        "pnm": ["grey8.pgm", "text.pgm", "grey12.pgm", "color8.ppm"],
        "tiff": ["grey8.tiff", "float.tiff", "pages.tiff", "deflate.tiff", "color8.tiff"],
    }.items():
        (seeds / folder).mkdir(parents=True, exist_ok=True)
        for name in names:
            (seeds / folder / name).write_bytes((out / name).read_bytes())
    (seeds / "names").mkdir(exist_ok=True)
    (seeds / "names" / "bmp.txt").write_text("{pattern}_{frame:02}.bmp\np64_00.bmp\np64_01.bmp\np8_00.bmp\n")
    (seeds / "names" / "view.txt").write_text(
        "v{view:03}/{frame}.png\nv000/1.png\nv000/2.png\nv001/1.png\nv001/2.png\n"
    )


if __name__ == "__main__":
    main()
