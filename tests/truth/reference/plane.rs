//! Places and vectors of the plane, with the same bits on every machine.

/// A place, or a vector.
pub type Place<T = f64> = [T; 2];

/// The vector of a length in a direction.
pub fn polar(length: f64, phi: f64) -> Place {
    let (s, c) = libm::sincos(phi);
    [length * c, length * s]
}

/// The way from one place to another.
pub fn way(from: Place, to: Place) -> Place {
    [to[0] - from[0], to[1] - from[1]]
}

/// The length of a vector.
pub fn length([x, y]: Place) -> f64 {
    libm::hypot(x, y)
}

/// How far apart two places are.
pub fn distance(a: Place, b: Place) -> f64 {
    length(way(a, b))
}

/// The direction of a vector against the x axis.
pub fn direction([x, y]: Place) -> f64 {
    libm::atan2(y, x)
}

/// The farthest that a point is from where it is in another pose.
pub fn farthest(one: &[Place], other: &[Place]) -> f64 {
    one.iter().zip(other).map(|(a, b)| distance(*a, *b)).fold(0.0, f64::max)
}
