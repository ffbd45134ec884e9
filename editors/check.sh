#!/usr/bin/env bash
# Holds the TextMate grammar to all scripts; installs what it needs into its own folder.
set -euo pipefail
cd "$(dirname "$0")/check"
[ -d node_modules ] || npm ci --no-audit --no-fund --silent
node check.mjs
