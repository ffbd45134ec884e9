//! The hash of the scene that every picture carries: of what was stated, not of where it went.

use std::collections::BTreeMap;
use std::path::Path;

use crate::support::talk::Talking;

const SCENE: &str = "
    point A = (0, 0) frozen, B = (1, 0), C = (3, 3), D = (4, 0) frozen
    let r = 3.5
    crank: motor A B radius 1 speed 1rev
    coupler: length B C = r
    rocker: length C D = 3
    set dt 1/36
";

/// What a picture says of the scene.
fn hash(talking: &mut Talking) -> String {
    talking.run("svg \"now.svg\"");
    let picture = &talking.talk.files[Path::new("now.svg")];
    let at = picture.find("scene: ").expect("it says what it is of");
    picture[at + 7..at + 7 + 16].to_owned()
}

#[test]
fn whatever_the_outcome_depends_on_changes_the_hash() {
    let mut by_hash: BTreeMap<String, &str> = BTreeMap::new();
    let edits = [
        "",
        "set weight 2 for C",
        "set weight 3 for C",
        "set weight 2 for B",
        "set rho 0.25 for coupler",
        "set rho 0.25 for rocker",
        "set rho 0.25",
        "set dt 1/72",
        "set method newton",
        "set iterations 31",
        "set tolerance 1e-9",
        "set cog velocity",
        "set dead-points stop",
        "move C to (3, 3.5)",
        "freeze C",
        "thaw D",
        "point E = (9, 9)",
        "let r = 3.25",
        "let q = 1",
        "change coupler = 3.5",
        "change coupler <= 3.5",
        "change rocker = 2.75",
        "change crank speed 2rev",
        "change crank phase 1deg",
        "off rocker",
        "delete rocker",
    ];
    for edit in edits {
        let mut talking = Talking::after(SCENE);
        talking.run(edit);
        if let Some(other) = by_hash.insert(hash(&mut talking), edit) {
            panic!("`{edit}` and `{other}` are of one hash");
        }
    }
}

#[test]
fn what_is_only_looked_at_or_has_passed_leaves_the_hash() {
    let mut talking = Talking::after(SCENE);
    let before = hash(&mut talking);
    for command in
        ["trace C", "expose", "list; check; show B", "step 7", "drag C to (2, 2)", "step 30"]
    {
        talking.run(command);
        assert_eq!(hash(&mut talking), before, "after `{command}`");
    }
    talking.run("set weight 2 for C");
    assert_ne!(hash(&mut talking), before);
    talking.run("undo");
    assert_eq!(hash(&mut talking), before);
}
