#!/usr/bin/env bash
# Builds the wheel, installs it into a fresh environment, and has the program from there run a
# script. `packaging/wheel.sh dev` does so with the quick build; the wheel is left in `dist/`.
set -euo pipefail
cd "$(dirname "$0")/.."
profile="${1:-release}"
room="$(mktemp -d)"
trap 'rm -rf "$room"' EXIT

python3 -m venv "$room/build"
"$room/build/bin/pip" install --quiet 'maturin>=1.9,<2'
"$room/build/bin/maturin" build --quiet --profile "$profile" --out dist

python3 -m venv "$room/user"
"$room/user/bin/pip" install --quiet --no-index --find-links dist linkwork
program="$room/user/bin/linkwork"
version="$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -1)"
test "$("$program" --version)" = "linkwork $version"
"$program" run scripts/gallery/four-bar.link --quiet --out "$room/out" | grep -q "after one turn C is at"
test -s "$room/out/four-bar.svg"
echo 'point A = (0, 0); svg "a.png"' | "$program" run - --quiet --out "$room/out"
test -s "$room/out/a.png"
"$room/user/bin/python" -c 'from linkwork import Session
with Session() as session:
    assert session.evaluate("6 * 7") == 42'
echo "the wheel of linkwork $version installs and runs"
