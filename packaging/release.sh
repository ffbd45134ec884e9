#!/usr/bin/env bash
# Makes the archive of a release for this platform, in `dist/`: the program, its manual page, what
# completes its command line in the shells, the grammar for editors; and its checksum. Ends with a
# run of the program out of the archive. `packaging/release.sh dev` does so with the quick build.
set -euo pipefail
cd "$(dirname "$0")/.."
profile="${1:-release}"
folder="target/$([ "$profile" = dev ] && echo debug || echo "$profile")"
version="$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -1)"
platform="$(rustc -vV | sed -n 's/^host: //p')"
name="linkwork-$version-$platform"
room="$(mktemp -d)"
trap 'rm -rf "$room"' EXIT

cargo build --quiet --locked --profile "$profile" --features pictures --bin linkwork
mkdir -p "$room/$name/man/man1" "$room/$name/completions" dist
cp "$folder/linkwork" README.md LICENSE CHANGELOG.md "$room/$name/"
cp editors/linkwork.tmLanguage.json "$room/$name/"
"$folder/linkwork" man > "$room/$name/man/man1/linkwork.1"
for shell in bash elvish fish powershell zsh; do
    "$folder/linkwork" completions "$shell" > "$room/$name/completions/linkwork.$shell"
done
tar -C "$room" -czf "dist/$name.tar.gz" "$name"
(cd dist && sha256sum "$name.tar.gz" > "$name.tar.gz.sha256")

rm -r "${room:?}/$name"
tar -C "$room" -xzf "dist/$name.tar.gz"
echo 'print 6 * 7' | "$room/$name/linkwork" run - | grep -qx 42
echo "dist/$name.tar.gz"
