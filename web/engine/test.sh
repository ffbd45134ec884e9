#!/usr/bin/env bash
# Builds the engine and holds it to the program. Where no compiler for WebAssembly can be had it says
# so, and that is no failure.
set -euo pipefail
cd "$(dirname "$0")/../.."

if ! wasm=$(web/engine/build.sh | tail -n 1); then
    echo "web/engine/test.sh: SKIPPED, the engine cannot be built here" >&2
    exit 0
fi
cargo build --release --quiet
node web/engine/same.mjs "$wasm" "${CARGO_TARGET_DIR:-target}/release/linkwork" scripts
