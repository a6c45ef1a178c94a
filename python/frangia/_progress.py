"""Progress on the terminal or in a notebook."""

from __future__ import annotations

from collections.abc import Callable


def progress_bar() -> Callable[[float, str], None] | None:
    """A function for `progress=` that draws a bar with tqdm where this is installed, else nothing."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    bar = tqdm(total=1.0, bar_format="{desc}: {percentage:3.0f}%|{bar}| {elapsed}")

    def show(share: float, stage: str) -> None:
        bar.set_description_str(stage)
        bar.n = share
        bar.refresh()

    return show
