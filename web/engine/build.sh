#!/usr/bin/env bash
# Builds the library as WebAssembly; its last line says where `engine.wasm` lies.
#
# Three ways, the first that there is: rustup's target; an installed target of another toolchain; the
# sources of the standard library in Debian's rust-web-src, fetched and unpacked for this alone.
set -euo pipefail
cd "$(dirname "$0")"
target=wasm32-unknown-unknown
say() { echo "web/engine/build.sh: $*" >&2; }

has_target() { [ -d "$(rustc --print sysroot)/lib/rustlib/$target/lib" ]; }

# rustup leaves what is there as it is.
if ! has_target && command -v rustup >/dev/null; then
    say "asking rustup for $target"
    rustup target add "$target" >&2 || say "rustup cannot have it"
fi

build() { cargo build --release --locked --target "$target" "$@" >&2; }

if has_target; then
    say "building with $(rustc --version)"
    build
else
    [ -n "$(command -v apt-get || true)" ] || { say "there is no compiler for $target here"; exit 1; }
    debian=${CARGO_TARGET_DIR:-$PWD/target}/debian
    if [ ! -x "$debian/usr/bin/rustc" ]; then
        say "unpacking Debian's rustc-web in $debian"
        mkdir -p "$debian/archives"
        # Of which version they are says Debian; the compiler's library is in one, LLVM in another.
        needs() { apt-cache depends "$@" | sed -n 's/^ *Depends: \([a-z]\)/\1/p'; }
        standard=$(needs libstd-rust-web-dev | grep '^libstd-rust-web-[0-9]')
        llvm=$(needs rustc-web "$standard" | grep -m 1 '^libllvm')
        (cd "$debian/archives" && \
            apt-get download rustc-web rust-web-src libstd-rust-web-dev "$standard" "$llvm") >&2
        for archive in "$debian"/archives/*.deb; do dpkg-deb --extract "$archive" "$debian"; done
    fi
    linker=$(find "$(rustc --print sysroot)" "$debian" -name rust-lld -type f 2>/dev/null | head -n 1)
    lib=$(dirname "$(find "$debian/usr/lib" -name 'libLLVM*.so*' | head -n 1)")
    say "building with $(LD_LIBRARY_PATH=$lib "$debian/usr/bin/rustc" --version)"
    RUSTC_BOOTSTRAP=1 RUSTC="$debian/usr/bin/rustc" LD_LIBRARY_PATH=$lib \
        CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=$linker \
        build -Zbuild-std=std,panic_abort
fi

made=${CARGO_TARGET_DIR:-$PWD/target}/$target/release/linkwork_engine.wasm
engine=$(dirname "$made")/engine.wasm
# wasm-opt would take an eighth off, three hundredths of what is sent packed, and minutes.
cp "$made" "$engine"
say "$(wc -c <"$engine") bytes"
echo "$engine"
