//! The objects of the schema, one function each.

use serde_json::{Map, Value, json};

use super::VERSION;
use crate::diag::{Diagnostic, Label, Severity, Sources, Span};
use crate::mobility::{DriverRange, RangeEnd, Reach};
use crate::session::finding::{
    ConstraintRow, Finding, Fit, Limits, Listing, MeasureRow, ParameterRow, PointRow, Swept,
};
use crate::session::summary::Summary;
use crate::session::sweep::Variant;
use crate::solve::Halt;
use crate::world::{self, World};

/// The first object of a stream.
pub fn opening() -> Value {
    json!({ "type": "linkwork", "version": VERSION, "release": env!("CARGO_PKG_VERSION") })
}

/// A line that was printed.
pub fn line(text: &str) -> Value {
    json!({ "type": "print", "text": text })
}

/// A place in a text: bytes from its beginning, lines and columns from 1.
pub fn place(span: Span, sources: &Sources) -> Value {
    let mut object = json!({ "start": span.start, "end": span.end });
    if let (Some(source), Some(place)) = (sources.get(span.source), sources.place(span)) {
        object["file"] = json!(&*source.name);
        object["line"] = place.line.into();
        object["column"] = place.column.into();
    }
    object
}

/// An error, a warning or a note.
pub fn diagnostic(what: &Diagnostic, sources: &Sources) -> Value {
    let word = match what.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    };
    let label = |label: &Label| {
        let mut object = place(label.span, sources);
        object["text"] = json!(label.text);
        object["primary"] = label.primary.into();
        object
    };
    let mut object = json!({ "type": word, "message": &*what.message });
    if let Some(code) = what.code {
        object["code"] = json!(code.to_string());
    }
    if !what.labels.is_empty() {
        object["places"] = what.labels.iter().map(label).collect();
    }
    for (key, texts) in [("helps", &what.helps), ("notes", &what.notes)] {
        if !texts.is_empty() {
            object[key] = json!(texts);
        }
    }
    if !what.via.is_empty() {
        object["via"] = what.via.iter().map(|&span| place(span, sources)).collect();
    }
    object
}

/// A value: a number, or a vector as two.
pub fn value(value: world::Value) -> Value {
    match value {
        world::Value::Number(n) => json!(n),
        world::Value::Vector(v) => json!([v.x, v.y]),
    }
}

/// What a statement found.
pub fn finding(finding: &Finding) -> Value {
    match finding {
        Finding::Printed(text, values) => {
            let values: Vec<Value> = values.iter().copied().map(value).collect();
            json!({ "type": "print", "text": text, "values": values })
        }
        Finding::Listed(listing) => listed("list", listing),
        Finding::Shown(name, listing) => {
            let mut object = listed("show", listing);
            object["name"] = json!(name);
            object
        }
        Finding::Checked(check) => check.object(),
        Finding::Effects(effects) => effects.object(),
        Finding::Limits(limits) => range(limits),
        Finding::Ran(summary, time, text) => receipt(summary, *time, text),
        Finding::Halted(driver, frame, halt) => halted(driver, *frame, *halt),
        Finding::Result(name, value) => json!({ "type": "result", "name": name, "value": value }),
        Finding::Fitted(fit) => fitted(fit),
        Finding::Swept(swept) => swept_object(swept),
        Finding::Wrote(path) => json!({ "type": "file", "path": path.to_string_lossy() }),
    }
}

fn receipt(summary: &Summary, time: f64, text: &str) -> Value {
    json!({
        "type": "receipt",
        "text": text,
        "time": time,
        "frames": summary.n_frames,
        "missed": summary.n_missed,
        "first_missed": summary.first_missed,
        "branch_changes": summary.n_turned_over,
        "status": summary.worst_status.word(),
        "residual": summary.worst_residual,
        "tolerance": summary.tolerance,
        "iterations": summary.n_iterations,
        "position_error": summary.position_error,
        "seconds": summary.seconds,
    })
}

fn fitted(fit: &Fit) -> Value {
    let parameters = fit.parameters.iter();
    let parameters: Map<String, Value> =
        parameters.map(|(name, number)| (name.clone(), json!(number))).collect();
    json!({
        "type": "fit",
        "parameters": parameters,
        "at_ends": fit.at_ends,
        "goal": fit.goal,
        "of": fit.what,
        "value": fit.value,
        "before": fit.before,
        "runs": fit.n_runs,
        "seconds": fit.seconds,
    })
}

fn swept_object(swept: &Swept) -> Value {
    json!({
        "type": "sweep",
        "table": swept.table,
        "columns": swept.columns,
        "rows": swept.n_rows,
        "of": swept.n_wanted,
        "run": swept.n_run,
        "failed": swept.n_failed,
        "missed": swept.n_missed,
        "dead_points": swept.n_dead,
    })
}

fn halted(driver: &str, frame: u64, halt: Halt) -> Value {
    let (why, angle) = match halt {
        Halt::DeadPoint(angle) => ("dead-point", angle),
        Halt::Stop(angle, _) => ("stop", angle),
        Halt::Unclear(angle) => ("unclear", angle),
    };
    json!({ "type": "halt", "driver": driver, "frame": frame, "why": why, "angle": angle })
}

fn range(limits: &Limits) -> Value {
    let mut object = json!({
        "type": "limits",
        "driver": limits.driver,
        "angle": limits.is_angle,
        "text": limits.text,
    });
    let Some(DriverRange { now, reach, change_points }) = &limits.range else { return object };
    object["now"] = json!(now);
    object["change_points"] = json!(change_points);
    object["reach"] = json!(reach.word());
    match reach {
        Reach::Full(turns) => object["turns"] = json!(turns),
        Reach::Between(from, to) => {
            object["from"] = end(*from, limits.stops[0].as_deref());
            object["to"] = end(*to, limits.stops[1].as_deref());
        }
        Reach::Open(n) => object["freedoms"] = json!(n),
        _ => {}
    }
    object
}

fn end(end: RangeEnd, stop: Option<&str>) -> Value {
    let why = match end {
        RangeEnd::DeadPoint(_) => "dead-point",
        RangeEnd::Stop(..) => "stop",
        RangeEnd::NoValue(..) => "no-value",
        RangeEnd::Lost(_) => "lost",
        RangeEnd::Endless(_) => "endless",
    };
    let mut object = json!({ "value": end.value(), "why": why });
    if let Some(name) = stop {
        object["by"] = json!(name);
    }
    object
}

fn listed(word: &str, listing: &Listing) -> Value {
    let parameter = |row: &ParameterRow| json!({ "name": row.name, "statement": row.statement, "value": row.value.map(value) });
    let point = |row: &PointRow| {
        let [x, y] = row.at;
        json!({ "name": row.name, "x": x, "y": y, "frozen": row.is_frozen, "weight": row.weight })
    };
    let constraint = |row: &ConstraintRow| {
        json!({
            "name": row.name,
            "statement": row.statement,
            "points": row.points,
            "on": row.is_on,
            "residual": row.residual,
        })
    };
    let measure = |row: &MeasureRow| {
        let statistics = row.statistics.iter();
        let mut object: Map<String, Value> =
            statistics.map(|(word, value)| ((*word).to_owned(), json!(value))).collect();
        object.insert("name".to_owned(), json!(row.name));
        object.insert("statement".to_owned(), json!(row.statement));
        Value::Object(object)
    };
    let definition = |(name, parameters): &(String, Vec<String>)| json!({ "name": name, "parameters": parameters });
    json!({
        "type": word,
        "parameters": listing.parameters.iter().map(parameter).collect::<Vec<_>>(),
        "points": listing.points.iter().map(point).collect::<Vec<_>>(),
        "constraints": listing.constraints.iter().map(constraint).collect::<Vec<_>>(),
        "traces": listing.traces.iter().map(|row| {
            let places = row.n_places;
            let ended = row.is_ended;
            labelled(json!({ "point": row.point, "every": row.every, "ended": ended, "places": places }), row.label.as_deref())
        }).collect::<Vec<_>>(),
        "measures": listing.measures.iter().map(measure).collect::<Vec<_>>(),
        "definitions": listing.definitions.iter().map(definition).collect::<Vec<_>>(),
    })
}

/// The paths that were traced, as columns of numbers.
pub fn traces(world: &World) -> Value {
    let trace = |trace: &world::Trace| {
        let column = |part: fn(&world::Sample) -> f64| -> Vec<f64> {
            trace.samples.iter().map(part).collect()
        };
        let object = json!({
            "point": world.points().name(trace.point),
            "every": trace.every,
            "ended": trace.is_ended,
            "x": column(|sample| sample.at.x),
            "y": column(|sample| sample.at.y),
            "missed": trace.samples.iter().map(|sample| sample.missed).collect::<Vec<bool>>(),
        });
        labelled(object, trace.label.as_deref())
    };
    json!({ "type": "traces", "traces": world.traces().iter().map(trace).collect::<Vec<_>>() })
}

/// A trace with what it is called, if not as its point.
fn labelled(mut trace: Value, label: Option<&str>) -> Value {
    if let Some(label) = label {
        trace["label"] = json!(label);
    }
    trace
}

/// What was measured, as columns of numbers.
pub fn measures(world: &World) -> Value {
    let measure = |(_, measure): (world::MeasureId, &world::Measure)| {
        let readings = measure.tally.readings();
        json!({
            "name": &*measure.name,
            "unit": measure.unit.suffix(),
            "time": readings.iter().map(|it| it.time).collect::<Vec<f64>>(),
            "value": readings.iter().map(|it| it.value).collect::<Vec<f64>>(),
        })
    };
    json!({ "type": "measures", "measures": world.measures().map(measure).collect::<Vec<_>>() })
}

/// A variant of a sweep.
pub fn variant(parameters: &[String], variant: &Variant) -> Value {
    let values = parameters.iter().zip(&variant.values);
    let values: Map<String, Value> =
        values.map(|(name, value)| (name.clone(), json!(value))).collect();
    let results = variant.results.iter();
    let results: Map<String, Value> =
        results.map(|(name, value)| (name.to_owned(), json!(value))).collect();
    let mut object = json!({
        "type": "variant",
        "variant": variant.number,
        "parameters": values,
        "results": results,
        "status": variant.word(),
        "residual": variant.residual,
        "missed": variant.n_missed,
        "dead_points": variant.n_dead_points,
    });
    if let Some(failure) = &variant.failure {
        object["error"] = json!(failure.text);
        object["problem"] = diagnostic(&failure.problem, &failure.sources);
    }
    object
}

/// The end of a statement.
pub fn statement(number: u64, text: &str, place: &Value, is_ok: bool, world: &World) -> Value {
    json!({
        "type": "statement",
        "number": number,
        "text": text,
        "place": place,
        "ok": is_ok,
        "frame": world.clock().frame,
        "time": world.clock().time(),
    })
}

/// The end of the answer to a request.
pub fn done(id: &Value, is_ok: bool) -> Value {
    let mut object = Map::new();
    object.insert("type".to_owned(), "done".into());
    object.insert("id".to_owned(), id.clone());
    object.insert("ok".to_owned(), is_ok.into());
    Value::Object(object)
}
