//! What the user chooses about solving.

/// How a frame is solved. [`Settings::default`] is what the language page promises.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Which way of solving.
    pub method: Method,
    /// The paper's relaxation coefficient rho, for constraints without one of their own.
    pub rho: f64,
    /// The most iterations between two frames.
    pub iterations: u32,
    /// Solved means: the largest distance to satisfaction, relative to the size of what hangs
    /// together, is no larger than this.
    pub tolerance: f64,
    /// How cog wheels made from now on are held in step.
    pub cog: CogForm,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            method: Method::Auto,
            rho: 0.5,
            iterations: 30,
            tolerance: 1e-12,
            cog: CogForm::Holonomic,
        }
    }
}

/// The ways of solving, one file each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Method {
    /// The best there is for what is to be solved.
    Auto,
    /// The paper's: all constraints corrected exactly and at once.
    Relaxation,
    /// Each constraint corrected in turn, as in Sketchpad.
    Successive,
    /// Steepest descent with a line search.
    Descent,
    /// Damped Gauss-Newton with the stiffness of stretched lengths.
    Newton,
    /// Nonlinear conjugate gradients.
    Conjugate,
    /// Nesterov's accelerated descent, restarted when it overshoots.
    Nesterov,
    /// Relaxation extrapolated after Anderson.
    Anderson,
}

impl Method {
    /// Every method, in the order a help text lists them.
    pub const ALL: [Self; 8] = [
        Self::Auto,
        Self::Relaxation,
        Self::Successive,
        Self::Descent,
        Self::Newton,
        Self::Conjugate,
        Self::Nesterov,
        Self::Anderson,
    ];

    /// The word of the command language.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Relaxation => "relaxation",
            Self::Successive => "successive",
            Self::Descent => "descent",
            Self::Newton => "newton",
            Self::Conjugate => "conjugate",
            Self::Nesterov => "nesterov",
            Self::Anderson => "anderson",
        }
    }

    /// Whether the relaxation coefficient is its step.
    pub const fn is_relaxed(self) -> bool {
        match self {
            Self::Relaxation | Self::Successive | Self::Anderson => true,
            Self::Auto | Self::Descent | Self::Newton | Self::Conjugate | Self::Nesterov => false,
        }
    }

    /// Whether it converges so fast that the tolerance says how far it goes, not the iterations.
    pub const fn goes_to_tolerance(self) -> bool {
        match self {
            Self::Auto | Self::Newton => true,
            Self::Relaxation
            | Self::Successive
            | Self::Descent
            | Self::Conjugate
            | Self::Nesterov
            | Self::Anderson => false,
        }
    }

    /// The method a word of the command language stands for.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.word() == word)
    }
}

/// The two forms of the cog wheel constraint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CogForm {
    /// Angles unwrapped and compared: no drift.
    Holonomic,
    /// The paper's: velocities at the contact, integrated frame by frame.
    Velocity,
}

impl CogForm {
    /// Both forms.
    pub const ALL: [Self; 2] = [Self::Holonomic, Self::Velocity];

    /// The word of the command language.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Holonomic => "holonomic",
            Self::Velocity => "velocity",
        }
    }
}
