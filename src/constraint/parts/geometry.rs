//! Points, vectors and angles of the plane.

use std::f64::consts::{PI, TAU};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::constraint::LARGEST;

/// A place in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Point {
    /// Distance to the right of the origin.
    pub x: f64,
    /// Distance above the origin.
    pub y: f64,
}

/// A difference of two places.
#[must_use]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Vector {
    /// Component to the right.
    pub x: f64,
    /// Component upward.
    pub y: f64,
}

impl Point {
    /// The point (0, 0).
    pub const ORIGIN: Self = Self::new(0.0, 0.0);

    /// The point (x, y).
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The vector from the origin to this point.
    pub const fn to_vector(self) -> Vector {
        Vector::new(self.x, self.y)
    }

    /// The distance between two points; cannot overflow before its result does.
    pub fn distance(self, other: Self) -> f64 {
        (other - self).norm()
    }

    /// Whether neither coordinate is infinite or not a number.
    pub const fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }

    /// Whether a point may be there: no coordinate is beyond [`LARGEST`].
    pub const fn is_in_reach(self) -> bool {
        self.x.abs() <= LARGEST && self.y.abs() <= LARGEST
    }
}

impl Vector {
    /// The vector of length 0.
    pub const ZERO: Self = Self::new(0.0, 0.0);

    /// The vector (x, y).
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The vector of length `r` in direction `phi`, radians.
    pub fn polar(r: f64, phi: f64) -> Self {
        let (s, c) = libm::sincos(phi);
        Self::new(r * c, r * s)
    }

    /// The point this vector leads to from the origin.
    pub const fn to_point(self) -> Point {
        Point::new(self.x, self.y)
    }

    /// The scalar product.
    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// The signed area of the parallelogram, positive when `other` lies to the left.
    pub fn cross(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// The vector turned a quarter turn to the left: the paper's J.
    pub const fn perp(self) -> Self {
        Self::new(-self.y, self.x)
    }

    /// The length squared.
    pub fn norm_squared(self) -> f64 {
        self.dot(self)
    }

    /// The length.
    pub fn norm(self) -> f64 {
        // The plain root is exact enough inside this range; outside it squares
        // would overflow or vanish.
        let s = self.norm_squared();
        if s > 1e-280 && s < 1e280 { s.sqrt() } else { libm::hypot(self.x, self.y) }
    }

    /// The vector of length 1 in the same direction; none for the zero vector.
    pub fn unit(self) -> Option<Self> {
        let l = self.norm();
        (l > 0.0).then(|| self / l)
    }

    /// The direction against the x axis, in (-pi, pi]; 0 for the zero vector.
    pub fn angle(self) -> f64 {
        libm::atan2(self.y, self.x)
    }

    /// The signed angle from this vector to `other`, in (-pi, pi].
    pub fn angle_to(self, other: Self) -> f64 {
        libm::atan2(self.cross(other), self.dot(other))
    }

    /// The vector turned by `phi` radians, counter-clockwise.
    pub fn rotate(self, phi: f64) -> Self {
        let (s, c) = libm::sincos(phi);
        self.times(Self::new(c, s))
    }

    /// The product as complex numbers.
    pub fn times(self, z: Self) -> Self {
        Self::new(self.x * z.x - self.y * z.y, self.x * z.y + self.y * z.x)
    }

    /// The product with the complex conjugate of `z`.
    pub fn times_conj(self, z: Self) -> Self {
        Self::new(self.x * z.x + self.y * z.y, self.y * z.x - self.x * z.y)
    }

    /// The quotient as complex numbers; `z` is not zero.
    pub fn over(self, z: Self) -> Self {
        let l = z.norm();
        self.times_conj(z / l) / l
    }

    /// Whether neither component is infinite or not a number.
    pub const fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

/// The angle equal to `phi` up to whole turns, in (-pi, pi].
#[allow(clippy::inline_always, reason = "it becomes part of loops over frames")]
#[inline(always)]
pub fn wrap(phi: f64) -> f64 {
    if phi > -PI && phi <= PI { phi } else { without_whole_turns(phi) }
}

#[cold]
fn without_whole_turns(phi: f64) -> f64 {
    let r = phi - TAU * (phi / TAU).round();
    if r <= -PI { r + TAU } else { r }
}

/// The same for an angle below one and a half turns either way, without branches.
#[allow(clippy::inline_always, reason = "it becomes part of loops that vectors are made of")]
#[inline(always)]
pub fn wrap_near(phi: f64) -> f64 {
    let whole = if phi > PI { TAU } else { 0.0 } - if phi <= -PI { TAU } else { 0.0 };
    phi - whole
}

/// Whether two points are far enough apart to have a direction: below the rounding of their
/// coordinates it would be noise.
pub fn has_direction(a: Point, b: Point) -> bool {
    let largest = a.x.abs().max(a.y.abs()).max(b.x.abs()).max(b.y.abs());
    a.distance(b) > 4.0 * f64::EPSILON * largest
}

/// The unit vector and the distance from `a` to `b`; (1, 0) for points that coincide, a
/// fixed choice that keeps runs reproducible and lets a rod leave length 0.
pub(crate) fn direction(a: Point, b: Point) -> (Vector, f64) {
    let v = b - a;
    let l = v.norm();
    if l > 0.0 { (v / l, l) } else { (Vector::new(1.0, 0.0), 0.0) }
}

impl Sub for Point {
    type Output = Vector;
    fn sub(self, o: Self) -> Vector {
        Vector::new(self.x - o.x, self.y - o.y)
    }
}
impl Add<Vector> for Point {
    type Output = Self;
    fn add(self, v: Vector) -> Self {
        Self::new(self.x + v.x, self.y + v.y)
    }
}
impl Sub<Vector> for Point {
    type Output = Self;
    fn sub(self, v: Vector) -> Self {
        Self::new(self.x - v.x, self.y - v.y)
    }
}
impl AddAssign<Vector> for Point {
    fn add_assign(&mut self, v: Vector) {
        *self = *self + v;
    }
}
impl Add for Vector {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self::new(self.x + o.x, self.y + o.y)
    }
}
impl Sub for Vector {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self::new(self.x - o.x, self.y - o.y)
    }
}
impl Neg for Vector {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y)
    }
}
impl Mul<f64> for Vector {
    type Output = Self;
    fn mul(self, k: f64) -> Self {
        Self::new(self.x * k, self.y * k)
    }
}
impl Mul<Vector> for f64 {
    type Output = Vector;
    fn mul(self, v: Vector) -> Vector {
        v * self
    }
}
impl Div<f64> for Vector {
    type Output = Self;
    fn div(self, k: f64) -> Self {
        Self::new(self.x / k, self.y / k)
    }
}
impl AddAssign for Vector {
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl SubAssign for Vector {
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}
impl MulAssign<f64> for Vector {
    fn mul_assign(&mut self, k: f64) {
        *self = *self * k;
    }
}
