//! What a page shows beside the mechanism, as JSON, part by part: only what changed is told.

use serde_json::{Map, Value, json};

use crate::session::Session;
use crate::world::PointId;

/// Scenes of more constraints are not analysed whenever something changed.
const MOST_ANALYSED: usize = 150;
/// Things of a kind that are told one by one: a page lists no more.
const MOST_LISTED: usize = 2000;

/// The parts that change with what is stated.
pub fn structure(session: &Session) -> Map<String, Value> {
    let world = session.world();
    let n_listed = world.points().ids().count().max(world.n_constraints());
    let mut parts = Map::new();
    let points = world.points().ids().take(MOST_LISTED);
    let points: Vec<Value> = points
        .map(|id| {
            let (name, is_frozen) = (world.points().name(id), world.points().is_frozen(id));
            json!({ "handle": id.0, "name": name, "frozen": is_frozen })
        })
        .collect();
    parts.insert("points".to_owned(), points.into());
    parts.insert("unlisted".to_owned(), json!(n_listed.saturating_sub(MOST_LISTED)));
    let mut motors = Vec::new();
    let constraints: Vec<Value> = session
        .constraint_views()
        .take(MOST_LISTED)
        .map(|it| {
            if let Some((speed, shown)) = &it.speed {
                motors.push(json!({
                    "handle": it.id.0, "name": it.name, "on": it.is_on, "speed": speed, "shown": shown,
                }));
            }
            json!({
                "handle": it.id.0,
                "name": it.name,
                "kind": it.kind,
                "text": it.text,
                "on": it.is_on,
                "points": it.points,
            })
        })
        .collect();
    parts.insert("constraints".to_owned(), constraints.into());
    parts.insert("motors".to_owned(), motors.into());
    let parameters = session.parameter_views().take(MOST_LISTED).map(|it| {
        json!({ "name": it.name, "text": it.text, "value": it.value, "live": it.is_live })
    });
    parts.insert("parameters".to_owned(), parameters.collect());
    let settings = session.setting_views().map(|(name, text, words, what)| {
        json!({ "name": name, "text": text, "words": words, "what": what })
    });
    parts.insert("settings".to_owned(), settings.collect());
    parts.insert("traced".to_owned(), world.traces().iter().map(|trace| trace.point.0).collect());
    parts
}

/// What an analysis of the mechanism finds, where that is quick.
pub fn analysis(session: &Session) -> Map<String, Value> {
    let mut parts = Map::new();
    let world = session.world();
    let is_quick = world.n_constraints() <= MOST_ANALYSED;
    let check = is_quick.then(|| session.examine());
    let freedoms = check.as_ref().map(|check| check.degrees_of_freedom);
    parts.insert("freedoms".to_owned(), json!(freedoms));
    let lines = check.as_ref().map(crate::session::Check::lines);
    parts.insert("check".to_owned(), json!(lines));
    let is_sound = check.as_ref().map(crate::session::Check::is_sound);
    parts.insert("sound".to_owned(), json!(is_sound));
    parts
}

/// What changes with each command.
pub fn progress(session: &Session, held: Option<(PointId, u32)>) -> Map<String, Value> {
    let clock = session.world().clock();
    let [undo, redo] = session.undo_and_redo();
    let receipt = session.last_run().map(|summary| session.receipt(summary));
    let parts = json!({
        "time": clock.time(),
        "frame": clock.frame,
        "dt": clock.dt,
        "undo": undo,
        "redo": redo,
        "receipt": receipt,
        "held": held.map(|(point, client)| json!({ "point": point.0, "client": client })),
    });
    match parts {
        Value::Object(parts) => parts,
        _ => unreachable!("it was written as an object"),
    }
}
