//! What a page shows beside the mechanism, as JSON.

use std::collections::BTreeMap;

use serde_json::{Map, Value as Json, json};

use crate::session::{Check, Session};
use crate::world::{PointId, Value};

/// Scenes of more constraints are not analysed whenever something changed.
const MOST_ANALYSED: usize = 150;
/// Things of a kind that are told one by one: a page lists no more.
const MOST_LISTED: usize = 2000;

/// The parts that change with what is stated.
pub fn structure(session: &Session) -> Map<String, Json> {
    let world = session.world();
    let n_listed = world.points().ids().count().max(world.n_constraints());
    let mut parts = Map::new();
    parts.insert("unlisted".to_owned(), json!(n_listed.saturating_sub(MOST_LISTED)));
    let mut motors = Vec::new();
    let mut users: BTreeMap<u32, Vec<String>> = BTreeMap::new();
    let constraints: Vec<Json> = session
        .constraint_views()
        .take(MOST_LISTED)
        .map(|it| {
            for &point in &it.points {
                users.entry(point).or_default().push(it.name.clone());
            }
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
    let points = world.points().ids().take(MOST_LISTED).map(|id| {
        json!({
            "handle": id.0,
            "name": world.points().name(id),
            "frozen": world.points().is_frozen(id),
            "used": users.get(&id.0).map_or(&[][..], |names| names),
        })
    });
    parts.insert("points".to_owned(), points.collect());
    parts.insert("constraints".to_owned(), constraints.into());
    parts.insert("motors".to_owned(), motors.into());
    let parameters = session.parameter_views().take(MOST_LISTED).map(|it| {
        let value = match it.value {
            Some(Value::Number(value)) => json!(value),
            Some(Value::Vector(value)) => json!([value.x, value.y]),
            None => Json::Null,
        };
        json!({
            "name": it.name, "text": it.text, "value": value, "live": it.is_live, "used": it.is_used,
        })
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
pub fn analysis(session: &Session) -> Map<String, Json> {
    let mut parts = Map::new();
    let world = session.world();
    let is_quick = world.n_constraints() <= MOST_ANALYSED;
    let check = is_quick.then(|| session.examine());
    let freedoms = check.as_ref().map(|check| check.degrees_of_freedom);
    let lines = check.as_ref().map(Check::lines);
    let verdict = lines.as_ref().and_then(|lines| lines.last()?.strip_prefix("status: "));
    parts.insert("freedoms".to_owned(), json!(freedoms));
    parts.insert("verdict".to_owned(), json!(verdict));
    parts.insert("check".to_owned(), json!(lines));
    parts.insert("sound".to_owned(), json!(check.as_ref().map(Check::is_sound)));
    parts
}

/// What changes with each command.
pub fn progress(session: &Session, held: Option<(PointId, u32)>) -> Map<String, Json> {
    let clock = session.world().clock();
    let [undo, redo] = session.undo_and_redo();
    let receipt = session.last_run().map(|summary| [session.receipt(summary)]);
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
        Json::Object(parts) => parts,
        _ => unreachable!("it was written as an object"),
    }
}
