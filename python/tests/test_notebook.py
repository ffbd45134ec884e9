"""A notebook is executed and shows the picture."""

from pathlib import Path

import nbclient
import nbformat


def test_a_notebook_shows_a_session_as_a_picture():
    notebook = nbformat.read(Path(__file__).parent / "four_bar.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    receipt, picture, width = (cell.outputs[0]["data"] for cell in notebook.cells)
    assert "360 frames, exact to 1e-12" in receipt["text/plain"]
    assert "<svg" in "".join(picture["image/svg+xml"])
    assert 0 < float(width["text/plain"]) < 6
