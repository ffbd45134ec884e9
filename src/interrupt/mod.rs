//! The wish to stop, asked for wherever work may be long.
//!
//! Loops that input can make long say how much they do with [`tick`]. Now and then that asks
//! whether the user wants to stop; if so, the stack is unwound to who [listens](listening), and who
//! listens puts back what was on its way. That is how a factorisation, an analysis or a picture is
//! left half made without each function between having to say so. Where nobody listens, and on other
//! threads than the one that does, nothing is asked and nothing unwinds.
//!
//! Who ticks while a world changes leaves it half changed: who catches that puts the world back, and lets
//! its solver begin anew.

use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::rc::Rc;

/// Says whether the user wants to stop.
pub type Wish = Rc<dyn Fn() -> bool>;

/// The work was left half done, because the user wanted to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stopped;

/// Ticks between two times of asking; one is a few nanoseconds of work, so that it is asked some
/// hundred times a second, and no statement that is done sooner is ever left half done.
const PATIENCE: u64 = 1 << 20;

thread_local! {
    static WISH: RefCell<Option<Wish>> = const { RefCell::new(None) };
    /// Ticks until it is asked again.
    static LEFT: Cell<u64> = const { Cell::new(u64::MAX) };
}

/// So much work is about to be done.
#[inline]
pub fn tick(n: usize) {
    let left = LEFT.get();
    if left > n as u64 {
        LEFT.set(left - n as u64);
    } else {
        ask();
    }
}

#[cold]
#[inline(never)]
fn ask() {
    let wish = WISH.with_borrow(Clone::clone);
    LEFT.set(if wish.is_some() { PATIENCE } else { u64::MAX });
    if wish.is_some_and(|is_wanted| is_wanted()) {
        resume_unwind(Box::new(Stopped));
    }
}

/// Asks the same of who puts everything back by themselves: whether the user wants to stop.
pub fn is_to_stop(n: usize) -> bool {
    catch(|| tick(n)).is_err()
}

/// What came before was not long: the next piece of work begins.
pub fn rest() {
    if LEFT.get() < PATIENCE {
        LEFT.set(PATIENCE);
    }
}

/// Does work that the user may stop.
///
/// # Errors
/// Where it was stopped: whatever it had under way is then half done.
pub fn listening<T>(wish: Option<Wish>, work: impl FnOnce() -> T) -> Result<T, Stopped> {
    let _before = Before::replaced_by(wish);
    catch(work)
}

/// Does a piece of work that the user may stop by itself, where somebody listens.
///
/// # Errors
/// Where it was stopped: whatever it had under way is then half done.
pub fn catch<T>(work: impl FnOnce() -> T) -> Result<T, Stopped> {
    // Who gets the error looks at nothing that was on its way.
    catch_unwind(AssertUnwindSafe(work)).map_err(|cause| match cause.downcast::<Stopped>() {
        Ok(stopped) => *stopped,
        Err(other) => resume_unwind(other),
    })
}

/// Lets who listens further out know what was [caught](catch) and put in order.
pub fn go_on(stopped: Stopped) -> ! {
    resume_unwind(Box::new(stopped))
}

/// Whether somebody listens here.
pub fn is_heard() -> bool {
    WISH.with_borrow(Option::is_some)
}

/// Does work that must not be left half done.
pub fn undisturbed<T>(work: impl FnOnce() -> T) -> T {
    let _before = Before::replaced_by(None);
    work()
}

/// Who listened before; listens again when this is dropped, however that comes.
struct Before(Option<Wish>);

impl Before {
    fn replaced_by(wish: Option<Wish>) -> Self {
        LEFT.set(if wish.is_some() { PATIENCE } else { u64::MAX });
        Self(WISH.replace(wish))
    }
}

impl Drop for Before {
    fn drop(&mut self) {
        let wish = self.0.take();
        LEFT.set(if wish.is_some() { PATIENCE } else { u64::MAX });
        WISH.set(wish);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn always() -> Wish {
        Rc::new(|| true)
    }

    #[test]
    fn long_work_is_left_and_short_work_is_not() {
        let work = |n: u64| {
            move || {
                (0..n).for_each(|_| tick(1 << 10));
                n
            }
        };
        assert_eq!(listening(Some(always()), work(100)), Ok(100));
        assert_eq!(listening(Some(always()), work(10_000)), Err(Stopped));
        assert_eq!(listening(None, work(10_000)), Ok(10_000));
        assert_eq!(listening(Some(always()), || undisturbed(work(10_000))), Ok(10_000));
        assert_eq!(listening(Some(always()), || catch(work(10_000))), Ok(Err(Stopped)));
        assert_eq!(work(10_000)(), 10_000);
    }

    #[test]
    fn many_short_pieces_are_not_left() {
        let pieces = || {
            (0..10_000).for_each(|_| {
                rest();
                tick(1 << 10);
            });
        };
        assert_eq!(listening(Some(always()), pieces), Ok(()));
    }

    #[test]
    #[should_panic(expected = "a mistake of ours")]
    fn another_cause_goes_on() {
        let _ = listening(Some(always()), || panic!("a mistake of ours"));
    }
}
