# Short names for what people do most; see CONTRIBUTING.md.

# All that has to hold before a change lands.
ci:
    .ci/run

# All tests.
test:
    cargo test

# The tests whose name holds this: `just one golden::mistakes`.
one name:
    cargo test --test it {{name}}

# Style and lints, as CI asks for them.
lint:
    cargo fmt --check
    cargo clippy --all-targets --quiet -- --deny warnings
    cargo clippy --lib --no-default-features --quiet -- --deny warnings

# Takes the present texts as the golden ones; read the difference before it is committed.
golden:
    UPDATE_GOLDEN=1 cargo test --test it golden::

# What a frame takes.
bench:
    cargo bench --bench frames

# Instructions of a frame, effect by effect; needs valgrind.
count:
    python3 benches/counting.py

# The documentation, without a broken link.
doc:
    RUSTDOCFLAGS=-Dwarnings cargo doc --no-deps

# Runs a script: `just run scripts/gallery/four-bar.link`.
run script:
    cargo run --release -- run {{script}} --out out
