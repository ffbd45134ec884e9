#!/usr/bin/env bash
# Tests the Python module over a program that is built already: `python/test.sh target/debug/linkwork`.
set -euo pipefail
cd "$(dirname "$0")/.."
export LINKWORK="$PWD/${1:-target/debug/linkwork}"
room="$(mktemp -d)"
trap 'rm -rf "$room"' EXIT

python3 -m venv "$room/python"
"$room/python/bin/pip" install --quiet 'pytest>=8,<10' 'numpy>=1.24' 'nbclient>=0.10,<1' 'ipykernel>=6,<8'
PYTHONPATH="$PWD/python" PATH="$room/python/bin:$PATH" \
    "$room/python/bin/python" -m pytest -q -p no:cacheprovider python/tests
PYTHONPATH="$PWD/python" "$room/python/bin/python" -m doctest python/linkwork/__init__.py
