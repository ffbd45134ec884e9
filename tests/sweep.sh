#!/usr/bin/env bash
# Runs the Dask recipe of docs/sweep.md on two local workers, of which one is killed midway: the table is
# complete all the same. Installs Dask into a folder of its own.
set -euo pipefail
cd "$(dirname "$0")/.."
program="$(realpath "${1:-target/debug/linkwork}")"
room="$(mktemp -d)"
trap 'rm -rf "$room"' EXIT

python3 -m venv "$room/python"
"$room/python/bin/pip" install --quiet 'distributed>=2024.1'
mkdir "$room/bin"
ln -s "$program" "$room/bin/linkwork"
# The recipe as it stands on the page, and the script before it.
awk '/^```python$/ { on = 1; next } /^```$/ { on = 0 } on' docs/sweep.md > "$room/recipe.py"
awk '/^```$/ && !on && !done { on = 1; next } /^```$/ && on { on = 0; done = 1 } on' docs/sweep.md \
    > "$room/four-bar.link"
cd "$room"
PYTHONPATH="$room" PATH="$room/bin:$PATH" "$room/python/bin/python" "$OLDPWD/tests/sweep.py"
