"""Progress on the terminal or in a notebook."""


def progress_bar():
    """A function for `progress=` that draws a bar with tqdm where this is installed, else nothing."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    bar = tqdm(total=1.0, bar_format="{desc}: {percentage:3.0f}%|{bar}| {elapsed}")

    def show(share, stage):
        bar.set_description_str(stage)
        bar.n = share
        bar.refresh()

    return show
