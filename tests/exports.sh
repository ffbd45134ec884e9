#!/usr/bin/env bash
# Gives what `export` writes to the programs that it is for: vpype reads the strokes, ezdxf audits the
# parts, OpenSCAD makes solids of them. Installs them: vpype and ezdxf from PyPI into a folder of
# their own, OpenSCAD from Debian unless it is there. Where it cannot be had that is said, and the rest
# is held.
set -euo pipefail
cd "$(dirname "$0")/.."
program="${1:-target/debug/linkwork}"
room="$(mktemp -d)"
trap 'rm -rf "$room"' EXIT

python3 -m venv "$room/python"
"$room/python/bin/pip" install --quiet 'vpype>=1.14,<2' 'ezdxf>=1.3,<2'
if ! command -v openscad > /dev/null && [ "$(id -u)" = 0 ] && command -v apt-get > /dev/null; then
    { apt-get update && apt-get install --yes --no-install-recommends openscad; } > /dev/null 2>&1 || true
fi

cat tests/parts.link - > "$room/parts.link" << 'END'
set dt 1/360; trace B, C; step 360
export "parts.dxf" in mm scale 10 width 12 hole 4 kerf 0.2
export "parts.svg" in mm scale 10 width 12 hole 4 kerf 0.2
export "plot.svg" in mm scale 10
END
"$program" run "$room/parts.link" --quiet --out "$room"
"$room/python/bin/python" tests/exports.py "$room"
