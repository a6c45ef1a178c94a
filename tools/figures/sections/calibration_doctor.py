"""Names the fault in simulated captures of a board that have exactly one, and none in captures without a fault.

Eight poses of 640 x 512 pixels are rendered once; each of 20 seeds adds camera noise, and chooses the view or pattern
where the fault concerns one.
"""
import functools
import json
import re

import cv2
import numpy

from board_captures import Capture, rendered

TITLE = "Faults of a calibration"

SEEDS = 20
PART = 4
POSES = 8


def view_of(path):
    return path.parts[1]


def is_fringe(path):
    return not path.name.startswith("white")


def chosen(seed):
    """The view that a fault of one view concerns."""
    return f"{seed % POSES:03d}"


def scaled(factor):
    return lambda frames, seed: {path: numpy.minimum(frame * factor, 1) for path, frame in frames.items()}


def hidden(frames, seed):
    """No board in six of the eight views."""
    return {
        path: frame if (int(view_of(path)) + seed) % POSES < 2 else numpy.full_like(frame, frame.mean())
        for path, frame in frames.items()
    }


def gamma(frames, seed):
    """A display with a gamma of 2.2; the white frame is the light of a pixel at full level."""
    white = {view_of(path): frame for path, frame in frames.items() if not is_fringe(path)}
    return {
        path: white[view_of(path)] * numpy.clip(frame / numpy.maximum(white[view_of(path)], 1e-6), 0, 1) ** 2.2
        if is_fringe(path)
        else frame
        for path, frame in frames.items()
    }


def swap(frames, view, pattern, first, second):
    for path in [
        path for path in frames if (view is None or view_of(path) == view) and path.name == f"{pattern}-{first}.png"
    ]:
        other = path.with_name(f"{pattern}-{second}.png")
        frames[path], frames[other] = frames[other], frames[path]
    return frames


def swapped(frames, seed):
    return swap(frames, None, ["columns-2", "rows-2", "columns-0"][seed % 3], 0, 1)


def swapped_once(frames, seed):
    return swap(frames, chosen(seed), ["columns-2", "rows-1", "columns-1"][seed % 3], 1, 2)


def opposite_once(frames, seed):
    """Two frames half a period apart, which leave no residual of the sinusoid."""
    return swap(frames, chosen(seed), ["columns-2", "rows-2"][seed % 2], 0, 2)


def exchanged_views(frames, seed):
    """The frames of one pattern of two views are exchanged, as by a script that names files."""
    other = f"{(seed + 1) % POSES:03d}"
    pattern = ["columns-2", "rows-2", "rows-0"][seed % 3]
    for path in [path for path in frames if view_of(path) == chosen(seed) and path.name.startswith(pattern)]:
        partner = path.parent.parent / other / path.name
        frames[path], frames[partner] = frames[partner], frames[path]
    return frames


def moved(frames, seed):
    """All frames of the rows of one view are shifted by 1.2 px, as a board that slips between the two directions shows them."""
    angle = numpy.random.default_rng(seed).uniform(0, 2 * numpy.pi)
    shift = numpy.float32([[1, 0, 1.2 * numpy.cos(angle)], [0, 1, 1.2 * numpy.sin(angle)]])
    return {
        path: cv2.warpAffine(frame, shift, frame.shape[::-1], flags=cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE)
        if view_of(path) == chosen(seed) and path.name.startswith("rows")
        else frame
        for path, frame in frames.items()
    }


def blurred(frames, seed):
    return {
        path: cv2.GaussianBlur(frame, None, 4.0) if view_of(path) == chosen(seed) else frame
        for path, frame in frames.items()
    }


def parallel(frames, seed):
    """The same pose in all views."""
    return {path: frames[path.parent.parent / chosen(seed) / path.name] for path in frames}


def mirrored_image(frames, seed):
    return {path: numpy.ascontiguousarray(frame[:, ::-1]) for path, frame in frames.items()}


def replaced(old, new, file="scan.toml", count=0):
    def change(text):
        assert re.search(old, text[file]), (old, file)
        text[file] = re.sub(old, new, text[file], count=count)
        return text

    return change


def without_rows(text):
    parts = re.split(r"(?=^\[)", text["scan.toml"], flags=re.M)
    text["scan.toml"] = "".join(part for part in parts if 'name = "rows' not in part)
    return text


def reversed_columns(text):
    """The vertical fringes run backwards, as from a projector that mirrors its image."""
    parts = re.split(r"(?=^\[)", text["scan.toml"], flags=re.M)
    for i, part in enumerate(parts):
        if 'name = "columns' in part:
            parts[i] = re.sub(
                r"shifts_deg = \[(.*)\]",
                lambda m: "shifts_deg = [" + ", ".join(str(-float(v) % 360) for v in m[1].split(",")) + "]",
                part,
            )
    text["scan.toml"] = "".join(parts)
    return text


def exchanged(text):
    """Horizontal and vertical are exchanged, with the periods of the directions that are stated."""
    parts = re.split(r"(?=^\[)", text["scan.toml"], flags=re.M)
    for i, part in enumerate(parts):
        if 'name = "columns' in part:
            part = part.rstrip("\n") + '\ndirection = "horizontal"\n\n'
            parts[i] = re.sub(r"period_px = ([\d.]+)", lambda m: f"period_px = {float(m[1]) * 570 / 912:.10g}", part)
        elif 'name = "rows' in part:
            part = part.replace('direction = "horizontal"\n', "")
            parts[i] = re.sub(r"period_px = ([\d.]+)", lambda m: f"period_px = {float(m[1]) * 912 / 570:.10g}", part)
    text["scan.toml"] = "".join(parts)
    return text


def two_views(text):
    parts = re.split(r"(?=^\[\[view\]\])", text["scan.toml"], flags=re.M)
    text["scan.toml"] = "".join(parts[:3])
    return text


def stated_baseline(text):
    """rig.toml states where the projector is."""
    text["rig.toml"] = text["rig.toml"].replace('model = "pinhole"', 'model = "pinhole"\nposition_mm = [-180, -20, 30]')
    return text


def wrong_square(text):
    return replaced(r"square_mm = ([\d.]+)", lambda m: f"square_mm = {1.1 * float(m[1]):.6g}")(stated_baseline(text))


# name, change of the frames, change of the text, words that the first message must have, the board
FAULTS = [
    ("none", None, None, None, "checkerboard"),
    ("none, baseline stated", None, stated_baseline, None, "checkerboard"),
    ("none, ChArUco", None, None, None, "charuco"),
    ("two poses only", None, two_views, "the scan has 2 views", "checkerboard"),
    ("board seen in two of eight views", hidden, None, "found in 2 of 8 views", "checkerboard"),
    ("all poses parallel", parallel, None, "parallel", "checkerboard"),
    ("board too dark", scaled(0.03), None, "too dark", "checkerboard"),
    ("board overexposed", scaled(4.0), None, "overexposed", "checkerboard"),
    (
        "wrong number of corners",
        None,
        replaced(r"corners = \[10, 7\]", "corners = [9, 7]"),
        r"set corners = \[10, 7\]",
        "checkerboard",
    ),
    ("wrong square, baseline stated", None, wrong_square, r"board.square_mm is", "checkerboard"),
    ("mirrored board (ChArUco)", mirrored_image, None, "markers of the board mirrored", "charuco"),
    ("mirrored projector", None, reversed_columns, "mirrored", "checkerboard"),
    ("rows and columns exchanged", None, exchanged, "rows and columns of the projector are exchanged", "checkerboard"),
    ("no horizontal fringes", None, without_rows, "no horizontal fringes", "checkerboard"),
    (
        "rig.toml of another camera",
        None,
        replaced(r"size_px = \[640, 512\]", "size_px = [1280, 1024]", "rig.toml"),
        "640",
        "checkerboard",
    ),
    ("projector with a gamma of 2.2", gamma, None, "projector is not linear", "checkerboard"),
    ("frames of a pattern swapped, all views", swapped, None, "do not follow its shifts", "checkerboard"),
    (
        "frames swapped in one view",
        swapped_once,
        None,
        r"frames of pattern .* in views/{view} do not follow",
        "checkerboard",
    ),
    ("frames half a period apart swapped, one view", opposite_once, None, r"views/{view}", "checkerboard"),
    (
        "frames of a pattern exchanged between two views",
        exchanged_views,
        None,
        r"views/{view}.*exchanged",
        "checkerboard",
    ),
    ("board moved within one view by 1.2 px", moved, None, r"moved during the capture of views/{view}", "checkerboard"),
    ("one view out of focus", blurred, None, r"out of focus or moving in views/{view}", "checkerboard"),
    ("none, circles", None, None, None, "circles"),
    ("circles moved within one view by 1.2 px", moved, None, r"moved during the capture of views/{view}", "circles"),
    ("circles out of focus in one view", blurred, None, r"out of focus or moving in views/{view}", "circles"),
]


CASES = {fault[0]: SEEDS for fault in FAULTS}


@functools.cache
def capture_of(study, board):
    return Capture(rendered(study, board, POSES))


def measure(study, case, seed):
    """The first warning or error of a calibration; None without one. Seeds count from 0 here."""
    _, change, text, _, board = next(fault for fault in FAULTS if fault[0] == case)
    changed = (lambda frames: change(frames, seed - 1)) if change else None
    scan = capture_of(study, board).write(study.work / "scan", 999 + seed, changed, text)
    result = study.process("--json", "calibrate", "rig", scan, "-o", scan / "found.toml", allowed=None)
    messages = [line.replace(f"{scan}/", "") for line in result.stderr.splitlines() if line.strip()]
    if messages:
        return messages[0]
    return next(iter(json.loads(result.stdout).get("warnings", [])), None) if result.stdout else None


def report(text, results):
    seeds = len(results["none"])
    text.add(
        f"`frangia calibrate rig` on {POSES} simulated poses of 640 × 512 pixels, {seeds} seeds of the noise. A fault is named if the first warning or error names it; without a fault there must be none.\n"
    )
    text.table("fault", "named first", "message")
    for name, _, _, words, _ in FAULTS:
        messages = results[name]
        if words is None:
            named = sum(message is None for message in messages)
            wrong = next((message for message in messages if message is not None), "")
        else:
            hits = [
                message is not None
                and re.search(words.format(view=chosen(seed)) if "{view}" in words else words, message)
                for seed, message in enumerate(messages)
            ]
            named = sum(map(bool, hits))
            wrong = next((message for message, hit in zip(messages, hits) if not hit), messages[0])
        text.row(
            name, f"{named} of {seeds}" if words else f"nothing in {named} of {seeds}", str(wrong).replace("|", "/")
        )
