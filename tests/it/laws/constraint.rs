//! What every kind of constraint promises, held against random scenes of one generator.

use super::random_constraint::{N_POINTS, Scene, Similarity, largest, rows, scenes};
use crate::support::draws::draws;
use linkwork::constraint::{
    Activity, Carried, Constraint, ConstraintKind, Field, Jet, Kind, Point, PointIdx, Quantity,
    Real, Row, Vec2, Vector,
};
use proptest::prelude::*;
use proptest::test_runner::TestCaseError;

/// The displacements a correction asks for, summed at each point.
fn correction(c: &Constraint, x: &[Point], w: &[f64]) -> Vec<Vector> {
    let mut d = vec![Vector::ZERO; x.len()];
    c.correct(x, w, &mut |p, v| d[p as usize] += v);
    d
}

/// All that tells it from others that hold the same points.
fn content(c: &Constraint) -> Vec<u64> {
    let mut words = Vec::new();
    c.content(&mut |word| words.push(word));
    words
}

fn equations(c: &Constraint, motion: &[[Vector; 3]]) -> Vec<Jet> {
    let place = |p: PointIdx| {
        let [x, v, a] = motion[p as usize];
        Vec2 { x: Jet::new(x.x, v.x, a.x), y: Jet::new(x.y, v.y, a.y) }
    };
    // Nothing but the points moves; a motor stands still.
    let field =
        |field: Field, value: f64| Jet::constant(if field == Field::Speed { 0.0 } else { value });
    let mut all = Vec::new();
    c.equations(&place, &field, &mut |f| all.push(f));
    all
}

fn moved(x: &[Point], d: &[Vector], by: f64) -> Vec<Point> {
    x.iter().zip(d).map(|(&p, &v)| p + v * by).collect()
}

fn close(a: f64, b: f64, tolerance: f64) -> Result<(), TestCaseError> {
    prop_assert!((a - b).abs() <= tolerance, "{a} and {b} differ by more than {tolerance}");
    Ok(())
}

/// Whether some displacement of the points that may move changes the residual.
fn can_move(c: &Constraint, x: &[Point], w: &[f64]) -> bool {
    rows(c, x).iter().any(|row| row.f != 0.0 && row.norm_squared(w) > 1e-20)
}

proptest! {
    #![proptest_config(ProptestConfig { max_global_rejects: 200_000, ..draws(4000) })]

    /// The postcondition of section 2: `f(x + d) = 0`, and frozen points stay.
    #[test]
    fn corrections_satisfy(scene in scenes(0.35, N_POINTS)) {
        check_satisfies(&scene)?;
    }

    /// The same where one point takes several parts in a constraint.
    #[test]
    fn corrections_satisfy_with_repeated_points(scene in scenes(0.2, 3)) {
        check_satisfies(&scene)?;
    }

    /// No correction moves the centre of gravity or turns the whole, but where the
    /// constraint is about a place or a direction of the plane.
    #[test]
    fn corrections_keep_centre_and_torque(scene in scenes(0.0, N_POINTS)) {
        let c = scene.constraint(Similarity::NONE);
        let d = correction(&c, &scene.x, &scene.w);
        let (mut force, mut torque, mut total) = (Vector::ZERO, 0.0, 0.0);
        let mut rounding = 0.0;
        for ((&x, &d), &w) in scene.x.iter().zip(&d).zip(&scene.w) {
            force += d / w;
            torque += x.to_vector().cross(d / w);
            total += d.norm() / w;
            rounding += 1e-14 / w;
        }
        if scene.kind != Kind::Coordinate {
            prop_assert!(force.norm() <= 1e-12 * total + rounding, "{force:?} of {total}");
        }
        // The two turns of an orientation balance for small angles only; what is measured on the axes
        // balances along them.
        let is_balanced = !scene.is_measured && scene.kind != Kind::Hold;
        if is_balanced && !matches!(scene.kind, Kind::Coordinate | Kind::Motor | Kind::CogVelocity | Kind::Orientation | Kind::Aligned) {
            prop_assert!(torque.abs() <= 1e-11 * total + 10.0 * rounding, "{torque} of {total}");
        }
    }

    /// Close to satisfaction the correction is the shortest displacement there is.
    #[test]
    fn corrections_are_shortest(scene in scenes(0.35, N_POINTS)) {
        let c = scene.constraint(Similarity::NONE);
        let Some(met) = satisfied(&c, &scene) else { return Ok(()) };
        // A segment cannot shrink below 0: at that kink there is no gradient. A short axis turns
        // far for little.
        let has_kinks =
            matches!(scene.kind, Kind::Equal | Kind::Symmetric) || scene.is_between_links();
        prop_assume!(!has_kinks || shortest_segment(&c, &met) > 0.01);
        let x = moved(&met, &scene.before.iter().zip(&scene.x).map(|(&a, &b)| a - b).collect::<Vec<_>>(), 1e-6);
        let d = correction(&c, &x, &scene.w);
        // Of all corrections the shortest lies in the span of the gradients: no displacement
        // that leaves every row as it is has a part in it.
        let rows = rows(&c, &x);
        let active: Vec<&Row> = rows.iter().filter(|r| r.is_active).collect();
        prop_assume!(active.len() <= 2);
        let mut shortest = vec![Vector::ZERO; x.len()];
        if let [a, b] = active[..] {
            // How the rows have to share, by Cramer's rule.
            let product = |a: &Row, b: &Row| -> f64 {
                let pairs = a.terms().flat_map(|s| b.terms().map(move |t| (s, t)));
                let same = pairs.filter(|((p, _), (q, _))| p == q);
                same.map(|((p, g), (_, h))| scene.w[p as usize] * g.dot(h)).sum()
            };
            let (aa, ab, bb) = (product(a, a), product(a, b), product(b, b));
            let det = aa * bb - ab * ab;
            prop_assume!(det > 1e-3 * aa * bb);
            for (row, k) in [(a, (ab * b.f - bb * a.f) / det), (b, (ab * a.f - aa * b.f) / det)] {
                row.terms().for_each(|(p, g)| shortest[p as usize] += g * (scene.w[p as usize] * k));
            }
        } else {
            active.iter().for_each(|r| r.correct(&scene.w, &mut |p, v| shortest[p as usize] += v));
        }
        let longest = shortest.iter().map(|v| v.norm()).fold(0.0, f64::max);
        for (d, s) in d.iter().zip(&shortest) {
            prop_assert!((*d - *s).norm() <= 1e-3 * longest + 1e-14, "{d:?} for {s:?}");
        }
    }

    /// Moving, turning and stretching the plane moves, turns and stretches the answer.
    #[test]
    fn nothing_depends_on_the_frame(
        scene in scenes(0.35, N_POINTS),
        angle in -3.0..3.0,
        scale in -3.0..3.0,
        shift in (-30.0..30.0, -30.0..30.0),
    ) {
        // What an axis is named for knows no other.
        let angle = if scene.kind == Kind::Aligned { 0.0 } else { angle };
        let by = Similarity { angle, scale: 10f64.powf(scale), shift: Vector::new(shift.0, shift.1) };
        let (here, there) = (scene.constraint(Similarity::NONE), scene.constraint(by));
        let y = by.points(&scene.x);
        let length_unit = match here.traits().quantity {
            Quantity::Angle => 1.0,
            Quantity::Length | Quantity::Number => by.scale,
        };
        // The shift costs digits of the small scales.
        let tolerance = 1e-9 * (1.0 + 30.0 / by.scale);
        let f = here.residual(&scene.x);
        // A turned half period decides by the last bit.
        prop_assume!(scene.kind != Kind::Orientation || f.abs() < 1.5);
        let size = scene.size(&here);
        close(f, there.residual(&y) / length_unit, tolerance * size)?;
        close(here.violation(&scene.x, &scene.w), there.violation(&y, &scene.w) / by.scale, tolerance * (size + here.violation(&scene.x, &scene.w)))?;
        let d = correction(&here, &scene.x, &scene.w);
        let longest = d.iter().map(|v| v.norm()).fold(size, f64::max);
        for (d, e) in d.iter().zip(correction(&there, &y, &scene.w)) {
            let e = (e / by.scale).rotate(-by.angle);
            prop_assert!((*d - e).norm() <= tolerance * longest, "{d:?} became {e:?}");
        }
    }

    /// What a kind says of itself is what its rows do and what it carries on.
    #[test]
    fn traits_are_true(scene in scenes(0.35, N_POINTS), shift in (-3.0..3.0, -3.0..3.0)) {
        let mut c = scene.constraint(Similarity::NONE);
        let traits = c.traits();
        let n_active =
            |x: &[Point]| rows(&c, x).iter().filter(|row| row.is_active).count();
        let [n_active, n_elsewhere] = [n_active(&scene.x), n_active(&scene.before)];
        match traits.activity {
            Activity::Always => {
                prop_assert_eq!(n_active, n_elsewhere);
                prop_assert!(traits.n_firm_rows <= n_active);
            }
            Activity::AtStops => prop_assert!(traits.n_firm_rows <= n_active),
            Activity::Outside => {
                prop_assert_eq!(traits.n_firm_rows, 0);
                prop_assert_eq!(n_active > 0, c.residual(&scene.x) != 0.0);
            }
        }
        if traits.is_linear {
            for &p in c.points() {
                let mut y = scene.x.clone();
                y[p as usize] += Vector::new(shift.0, shift.1);
                let gradient = |x: &[Point]| -> Vec<Option<Vector>> {
                    let of_p = |row: &Row| row.terms().find(|(q, _)| *q == p).map(|(_, g)| g);
                    rows(&c, x).iter().map(of_p).collect()
                };
                prop_assert_eq!(gradient(&scene.x), gradient(&y));
            }
        }
        prop_assert_eq!(traits.carried == Carried::Nothing, c.state().is_none());
        let before = content(&c);
        let is_turned = c.advance(1.0);
        let turns = c.get(Field::Speed).is_some_and(|speed| speed != 0.0);
        prop_assert_eq!(is_turned, turns && traits.carried == Carried::ByClock);
        prop_assert_eq!(content(&c) != before, is_turned);
        let before = content(&c);
        c.accept(&scene.x);
        let is_moved_on = matches!(traits.carried, Carried::ByPose | Carried::ByFrame);
        prop_assert!(is_moved_on || content(&c) == before);
        let own: Vec<Field> = Field::ALL.into_iter().filter(|&field| !c.measures(field)).collect();
        for field in own {
            let before = content(&c);
            match c.get(field).filter(|value| value.is_finite()) {
                Some(value) => prop_assert!(c.set(field, value + 1.0) && content(&c) != before),
                None => prop_assert!(c.get(field).is_some() || !c.set(field, 1.0)),
            }
        }
    }

    /// What is shown of a constraint is what the solver works on: where one row asks for
    /// something, the residual is its value, sign and all; where several do, it is no smaller
    /// than any.
    #[test]
    fn a_residual_is_that_of_its_rows(scene in scenes(0.35, N_POINTS)) {
        check_residual(&scene)?;
    }

    /// The same where one point takes several parts.
    #[test]
    fn a_residual_is_that_of_its_rows_with_repeated_points(scene in scenes(0.35, 3)) {
        check_residual(&scene)?;
    }

    /// Rows, equations and differences of equations tell the same story.
    #[test]
    fn derivatives_agree(scene in scenes(0.0, N_POINTS), speeds in proptest::collection::vec((-1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0), N_POINTS)) {
        check_derivatives(&scene, &speeds)?;
    }

    /// The same where one point takes several parts.
    #[test]
    fn derivatives_agree_with_repeated_points(scene in scenes(0.0, 3), speeds in proptest::collection::vec((-1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0), N_POINTS)) {
        check_derivatives(&scene, &speeds)?;
    }

    /// Points on one spot, in one line, very near, very far or all frozen: every number
    /// stays a number, and satisfied or not, the same rows are there.
    #[test]
    fn degenerate_scenes_stay_finite(
        scene in scenes(0.35, N_POINTS),
        places in proptest::collection::vec((0..3i8, 0..2i8), N_POINTS),
        scale in proptest::sample::select(vec![1e-9, 1.0, 1e9]),
        all_frozen in any::<bool>(),
    ) {
        let mut scene = scene;
        scene.x = places.iter().map(|&(x, y)| Point::new(f64::from(x), f64::from(y))).collect();
        scene.before.clone_from(&scene.x);
        scene.before.reverse();
        if all_frozen {
            scene.w.fill(0.0);
        }
        let by = Similarity { angle: 0.0, scale, shift: Vector::ZERO };
        let mut c = scene.constraint(by);
        let x = by.points(&scene.x);
        // A line whose points are in one place has no distance from a centre.
        let touches_line = scene.kind == Kind::Touch && scene.variant == 2;
        let [a, b] = [0, 1].map(|k| scene.points[k] as usize);
        prop_assume!(!touches_line || scene.x[a] != scene.x[b] && scene.before[a] != scene.before[b]);
        if c.traits().carried == Carried::ByFrame {
            c.accept(&x);
        }
        let rows = rows(&c, &x);
        prop_assert_eq!(rows.len(), c.n_rows());
        for row in &rows {
            prop_assert!(row.f.is_finite() && row.span.is_finite(), "{row:?}");
            prop_assert!(row.terms().all(|(_, g)| g.is_finite()), "{row:?}");
        }
        prop_assert!(c.residual(&x).is_finite());
        prop_assert!(c.violation(&x, &scene.w).is_finite());
        let d = correction(&c, &x, &scene.w);
        let reach = 1e3 * scale * (1.0 + c.violation(&x, &scene.w) / scale);
        for (d, w) in d.iter().zip(&scene.w) {
            prop_assert!(d.norm() <= reach, "{d:?}");
            prop_assert!(*w > 0.0 || *d == Vector::ZERO, "a frozen point moved");
        }
        let motion: Vec<_> = x.iter().map(|p| [p.to_vector(), Vector::new(1.0, 0.5), Vector::ZERO]).collect();
        for f in equations(&c, &motion) {
            prop_assert!(f.v.is_finite() && f.d.is_finite() && f.dd.is_finite(), "{f:?}");
        }
        c.accept(&moved(&x, &d, 1.0));
        prop_assert!(c.residual(&x).is_finite());
    }
}

/// A pose nearby that satisfies the constraint.
fn satisfied(c: &Constraint, scene: &Scene) -> Option<Vec<Point>> {
    let mut x = scene.x.clone();
    for _ in 0..100 {
        if c.violation(&x, &scene.w) <= 1e-13 * 10.0 {
            return Some(x);
        }
        x = moved(&x, &correction(c, &x, &scene.w), 1.0);
    }
    None
}

/// Whether a solution surely exists within reach: some constraints leave none to what is free.
fn has_solution(scene: &Scene, c: &Constraint) -> bool {
    // What is measured may be far from what can be had.
    if scene.is_measured || scene.kind == Kind::Hold {
        return false;
    }
    let is_free = |i: usize| scene.w[c.points()[i] as usize] > 0.0;
    let n_frozen = (0..c.points().len()).filter(|&i| !is_free(i)).count();
    match scene.kind {
        // Two frozen points may contradict the shape.
        Kind::Rigid => n_frozen < 2,
        // On a circle of a given radius there is a place in every direction, but from its centre.
        Kind::Touch => scene.variant == 0 && is_free(0) && !scene.has_repeats(),
        // A frozen segment may be shorter than the difference asked of the other. Where the
        // two share a point, a segment that shrinks to 0 is a kink on the way.
        Kind::Equal => {
            let shortest = shortest_segment(c, &scene.x);
            let is_near = c.residual(&scene.x).abs() < 0.5 * shortest;
            // A length against a multiple of itself is one length only, or none.
            let is_plain = c.get(Field::Ratio) == Some(1.0);
            n_frozen < 2 && (!scene.has_repeats() || is_plain && is_near)
        }
        // No line through a frozen point is farther from another than that point.
        Kind::Distance => is_free(0),
        // Turning the line or the line of centres alone reaches some way only, and a short
        // spoke or small wheel turns by more than the half turn that can be counted.
        Kind::Rack => {
            let Constraint::Rack(rack) = c else { return false };
            let radius = rack.radius().abs();
            let rim_is_on_line = c.points()[2..].contains(&c.points()[1]);
            let is_calm = shortest_segment(c, &scene.x) > 2.0 && radius > 1.0;
            is_free(1) && is_calm && !rim_is_on_line
        }
        // A short axis turns far for little, and one point in two parts may have no image.
        Kind::Symmetric => {
            let [_, _, p, q] = four(c);
            let is_calm = scene.x[p].distance(scene.x[q]) > 2.0;
            (is_free(0) || is_free(1)) && is_calm && !scene.has_repeats()
        }
        // Where the crank itself is held, both its length and its angle may be wrong.
        Kind::Motor if scene.is_between_links() => {
            let [_, _, s, e] = four(c);
            is_free(1) && scene.x[s].distance(scene.x[e]) > 2.0 && !scene.has_repeats()
        }
        Kind::Cog if shortest_segment(c, &scene.x) < 2.0 => false,
        Kind::Cog => is_free(1) || (is_free(3) && scene.ratio() != 0.0),
        _ => true,
    }
}

/// The points of a constraint that holds four.
fn four(c: &Constraint) -> [usize; 4] {
    std::array::from_fn(|k| c.points()[k] as usize)
}

fn shortest_segment(c: &Constraint, x: &[Point]) -> f64 {
    let lengths = c.points().chunks_exact(2).map(|s| x[s[0] as usize].distance(x[s[1] as usize]));
    lengths.fold(f64::INFINITY, f64::min)
}

fn check_satisfies(scene: &Scene) -> Result<(), TestCaseError> {
    let c = scene.constraint(Similarity::NONE);
    prop_assume!(has_solution(scene, &c));
    let tolerance = 1e-12 * scene.size(&c);
    let mut x = scene.x.clone();
    let mut n_steps = 0;
    while c.residual(&x).abs() > tolerance && can_move(&c, &x, &scene.w) {
        prop_assert!(
            n_steps < if scene.is_exact() { 1 } else { 100 },
            "f = {} after {n_steps}",
            c.residual(&x)
        );
        let d = correction(&c, &x, &scene.w);
        for (d, w) in d.iter().zip(&scene.w) {
            prop_assert!(*w > 0.0 || *d == Vector::ZERO, "a frozen point moved");
        }
        x = moved(&x, &d, 1.0);
        n_steps += 1;
    }
    Ok(())
}

fn check_residual(scene: &Scene) -> Result<(), TestCaseError> {
    let c = scene.constraint(Similarity::NONE);
    let (f, tolerance) = (c.residual(&scene.x), 1e-12 * scene.size(&c));
    let asking: Vec<f64> =
        rows(&c, &scene.x).iter().filter(|row| row.is_active).map(|row| row.f).collect();
    match asking[..] {
        [] => close(f, 0.0, 0.0),
        // Of a body a distance is shown, however few points it has.
        [row] if scene.kind == Kind::Rigid => close(f, row.abs(), tolerance),
        [row] => close(f, row, tolerance),
        _ => {
            let largest = asking.iter().fold(0.0_f64, |most, row| most.max(row.abs()));
            prop_assert!(f >= largest - tolerance, "{f} for {asking:?}");
            Ok(())
        }
    }
}

fn check_derivatives(scene: &Scene, speeds: &[(f64, f64, f64, f64)]) -> Result<(), TestCaseError> {
    const H: f64 = 1e-5;
    let c = scene.constraint(Similarity::NONE);
    let motion: Vec<_> = scene
        .x
        .iter()
        .zip(speeds)
        .map(|(x, s)| [x.to_vector(), Vector::new(s.0, s.1), Vector::new(s.2, s.3)])
        .collect();
    // The same motion a moment later or earlier.
    let at = |t: f64| -> Vec<[Vector; 3]> {
        motion.iter().map(|&[x, v, a]| [x + v * t + a * (0.5 * t * t), v + a * t, a]).collect()
    };
    let pose = |m: &[[Vector; 3]]| -> Vec<Point> { m.iter().map(|m| m[0].to_point()).collect() };
    let rate = |m: &[[Vector; 3]], row: &Row| -> f64 {
        row.terms().map(|(p, g)| g.dot(m[p as usize][1])).sum()
    };
    let (early, late) = (at(-H), at(H));
    let [now_rows, early_rows, late_rows] = [&motion, &early, &late].map(|m| rows(&c, &pose(m)));
    let jets = equations(&c, &motion);
    prop_assert_eq!(now_rows.len(), c.n_rows());
    prop_assert_eq!(jets.len(), c.n_rows());
    for i in 0..c.n_rows() {
        let (now, before, after, jet) = (&now_rows[i], &early_rows[i], &late_rows[i], jets[i]);
        let mut points: Vec<_> = now.terms().map(|(p, _)| p).collect();
        points.sort_unstable();
        points.dedup();
        let n_points = now.n_points + now.further.len();
        prop_assert_eq!(points.len(), n_points, "a point twice in a row");
        close(jet.v, now.f, 1e-12 * scene.size(&c))?;
        // Where an inequality or an end stop switches there is no derivative.
        if now.is_active != before.is_active || now.is_active != after.is_active {
            continue;
        }
        if (after.f - before.f).abs() > 1.0 || (now.gradient[0] - after.gradient[0]).norm() > 0.3 {
            continue;
        }
        // Short spokes and segments bend the equations: differences are as good as the
        // gradients are small.
        let bend = 1.0 + largest(now).max(largest(after)).powi(3);
        let rate_now = rate(&motion, now);
        close((after.f - before.f) / (2.0 * H), rate_now, 1e-6 * bend)?;
        close(jet.d, rate_now, 1e-11 * bend)?;
        let second = (rate(&late, after) - rate(&early, before)) / (2.0 * H);
        close(jet.dd, second, 1e-5 * bend * bend)?;
    }
    Ok(())
}
