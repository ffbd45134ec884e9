//! What part of the plane a page shows, and where on the page each point of it lies.

use crate::constraint::{Point, Vector};

/// The long side of a page, px.
const LONG_SIDE: f64 = 800.0;
/// The least short side, px: a row of collinear points still gets a page one can look at.
const SHORT_SIDE: f64 = 200.0;
/// Free space around the mechanism, px: room for ground triangles, motors and names, which
/// have a size on the page and none in the plane.
pub const MARGIN: f64 = 48.0;
/// The height of the legend below the drawing, its scale included, px.
pub const LEGEND_HEIGHT: f64 = 34.0;

/// The smallest box around what was put into it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BoundingBox {
    corners: Option<(Point, Point)>,
}

impl BoundingBox {
    /// The lower left and the upper right corner, if there is anything in it.
    pub const fn corners(&self) -> Option<(Point, Point)> {
        self.corners
    }

    /// Grows to hold a point.
    pub fn include(&mut self, p: Point) {
        let (lo, hi) = self.corners.unwrap_or((p, p));
        self.corners = Some((
            Point::new(lo.x.min(p.x), lo.y.min(p.y)),
            Point::new(hi.x.max(p.x), hi.y.max(p.y)),
        ));
    }

    /// Grows to hold a circle.
    pub fn include_circle(&mut self, centre: Point, radius: f64) {
        let r = Vector::new(radius, radius);
        for corner in [centre - r, centre + r] {
            if corner.is_finite() {
                self.include(corner);
            }
        }
    }
}

/// A map from the plane (y up, world units) to a page (y down, px), the same scale on both
/// axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Page {
    /// px per world unit.
    scale: f64,
    /// What lies in the middle of the drawing.
    centre: Point,
    /// Size of the page without the legend, px.
    width: f64,
    height: f64,
    /// How large marks and strokes are drawn; 1 where there is room.
    mark: f64,
    is_empty: bool,
}

impl Page {
    /// The page that shows all of `bounds`, as large as the page allows.
    pub fn fit(bounds: &BoundingBox) -> Self {
        Self::fit_within(bounds, LONG_SIDE)
    }

    /// The same for a page that is shown so wide, px: where that is less than usual all is drawn
    /// closer together, so that letters and marks can be seen.
    pub fn fit_width(bounds: &BoundingBox, shown: Option<u32>) -> Self {
        let usual = Self::fit(bounds);
        match shown.map(f64::from) {
            Some(shown) if shown < usual.width => Self::fit_within(bounds, shown.max(SHORT_SIDE)),
            _ => usual,
        }
    }

    /// The page no wider than that, and no higher than pages are.
    fn fit_within(bounds: &BoundingBox, most_wide: f64) -> Self {
        let (lo, hi) = bounds.corners.unwrap_or((Point::ORIGIN, Point::ORIGIN));
        // Halved before they are combined: the corners may be as far apart as f64 reaches.
        let centre = Point::new(0.5 * lo.x + 0.5 * hi.x, 0.5 * lo.y + 0.5 * hi.y);
        let (half_x, half_y) = (0.5 * hi.x - 0.5 * lo.x, 0.5 * hi.y - 0.5 * lo.y);
        let free = |side: f64| 0.5 * side - MARGIN;
        let fitted = (free(most_wide) / half_x).min(free(LONG_SIDE) / half_y);
        // All in one place, or closer together than a scale can express.
        let scale = if fitted.is_finite() && fitted > 0.0 { fitted } else { 1.0 };
        let side =
            |half: f64, most: f64| (2.0 * (half * scale + MARGIN)).clamp(SHORT_SIDE, most).round();
        Self {
            scale,
            centre,
            width: side(half_x, most_wide),
            height: side(half_y, LONG_SIDE),
            mark: 1.0,
            is_empty: bounds.corners.is_none(),
        }
    }

    /// What lies in `bounds` at a scale of its own, without a page around it: places are px from the
    /// origin, or from the middle of what lies too far from there. A scale that is none is that of the
    /// page that shows all.
    pub fn at_scale(bounds: &BoundingBox, scale: Option<f64>) -> Self {
        /// px that single precision tells apart to a hundredth.
        const FAR: f64 = 1e5;
        let fitted = Self::fit(bounds);
        let scale = scale.filter(|scale| scale.is_normal() && *scale > 0.0);
        let scale = scale.unwrap_or(fitted.scale);
        let is_near = fitted.centre.to_vector().norm() * scale < FAR;
        let centre = if is_near { Point::ORIGIN } else { fitted.centre };
        Self { scale, centre, width: 0.0, height: 0.0, ..fitted }
    }

    /// The same page with marks and strokes in proportion to bars of `typical` length, world
    /// units, so that a crowd of short bars does not become a blot.
    #[must_use]
    pub fn with_bars(self, typical: f64) -> Self {
        // A bar should be some seven times as long as it is wide, and no finer than a hair.
        const FULL_SIZE: f64 = 56.0;
        const FINEST: f64 = 0.3;
        Self { mark: (self.length(typical) / FULL_SIZE).clamp(FINEST, 1.0), ..self }
    }

    /// Where a point lies on the page.
    pub fn px(&self, p: Point) -> Point {
        let v = p - self.centre;
        Point::new(0.5 * self.width + v.x * self.scale, 0.5 * self.height - v.y * self.scale)
    }

    /// How long something is on the page, px.
    pub fn length(&self, world: f64) -> f64 {
        world * self.scale
    }

    /// What lies in the middle of the drawing.
    pub const fn centre(&self) -> Point {
        self.centre
    }

    /// px per world unit.
    pub const fn scale(&self) -> f64 {
        self.scale
    }

    /// How large marks and strokes are drawn, at most 1.
    pub const fn mark(&self) -> f64 {
        self.mark
    }

    /// Size of the drawing without the legend below it, px.
    pub const fn size(&self) -> (f64, f64) {
        (self.width, self.height)
    }

    /// Whether there is nothing to see.
    pub const fn is_empty(&self) -> bool {
        self.is_empty
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page_of(points: &[(f64, f64)]) -> Page {
        let mut bounds = BoundingBox::default();
        for &(x, y) in points {
            bounds.include(Point::new(x, y));
        }
        Page::fit(&bounds)
    }

    #[test]
    fn everything_is_on_the_page_whatever_the_scale() {
        for scale in [1e-300, 1e-9, 1.0, 1e6, 1e300] {
            let corners = [(-scale, 0.0), (3.0 * scale, scale), (0.0, -2.0 * scale)];
            let page = page_of(&corners);
            let (width, height) = page.size();
            for (x, y) in corners {
                let p = page.px(Point::new(x, y));
                assert!(p.x >= MARGIN - 1.0 && p.x <= width - MARGIN + 1.0, "{p:?}");
                assert!(p.y >= MARGIN - 1.0 && p.y <= height - MARGIN + 1.0, "{p:?}");
            }
        }
    }

    #[test]
    fn degenerate_boxes_have_a_page() {
        for corners in [
            &[][..],
            &[(5.0, -7.0)],
            &[(0.0, 0.0), (0.0, 5e-324)],
            &[(f64::MAX, 0.0), (-f64::MAX, 1.0)],
        ] {
            let page = page_of(corners);
            let (width, height) = page.size();
            assert!(width >= SHORT_SIDE && height >= SHORT_SIDE);
            for &(x, y) in corners {
                assert!(page.px(Point::new(x, y)).is_finite());
            }
        }
    }

    #[test]
    fn a_narrow_page_is_as_wide_as_it_is_shown() {
        let mut bounds = BoundingBox::default();
        bounds.include(Point::new(-3.0, 0.0));
        bounds.include(Point::new(3.0, 6.0));
        let sizes = [None, Some(2000), Some(400), Some(90)]
            .map(|shown| Page::fit_width(&bounds, shown).size());
        assert_eq!(sizes, [(800.0, 800.0), (800.0, 800.0), (400.0, 400.0), (200.0, 200.0)]);
        bounds.include(Point::new(0.0, 60.0));
        let tall = Page::fit_width(&bounds, Some(300));
        assert_eq!(tall, Page::fit(&bounds), "its height says how large it can be");
    }

    #[test]
    fn up_is_up() {
        let page = page_of(&[(0.0, 0.0), (1.0, 1.0)]);
        let (low, high) = (page.px(Point::ORIGIN), page.px(Point::new(1.0, 1.0)));
        assert!(high.y < low.y && high.x > low.x);
    }
}
