//! The examples run to their ends.

#[path = "../../examples/four_bar.rs"]
mod four_bar;
#[path = "../../examples/own_host.rs"]
mod own_host;
#[path = "../../examples/pictures.rs"]
mod pictures;

#[test]
fn a_four_bar_turns() {
    four_bar::main().unwrap();
}

#[test]
fn pictures_are_drawn() {
    pictures::main().unwrap();
}

#[test]
fn a_host_of_ones_own_is_served() {
    own_host::main().unwrap();
}
