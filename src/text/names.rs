//! Things by the names that people give for them.

/// Names that were given up, each with what it is now: still understood, never listed.
const FORMER: &[(&str, &str)] = &[
    ("seed", "tutorial"),
    ("cursor-left", "left"),
    ("cursor-right", "right"),
    ("cursor-up", "up"),
    ("cursor-down", "down"),
    ("cursor-far-left", "far-left"),
    ("cursor-far-right", "far-right"),
    ("cursor-far-up", "far-up"),
    ("cursor-far-down", "far-down"),
    ("cursor-center", "center"),
    ("snap-tangent", "tangent"),
    ("next-probe", "next-place"),
    ("previous-probe", "previous-place"),
    ("pan-left", "slide-left"),
    ("pan-right", "slide-right"),
    ("pan-up", "slide-up"),
    ("pan-down", "slide-down"),
    ("dolly-in", "forward"),
    ("dolly-out", "backward"),
    ("look-at-sphere", "look-at"),
    ("shrink", "smaller"),
    ("step-coarser", "coarser"),
    ("step-finer", "finer"),
    ("edit", "values"),
    ("precision", "digits"),
    ("next-step", "next"),
    ("previous-step", "back"),
    ("first-step", "first"),
    ("last-step", "last"),
    ("scrub-forward", "point-forward"),
    ("scrub-back", "point-back"),
    ("scrub-home", "point-home"),
    ("panel-quadratic", "quadratic"),
    ("panel-steps", "steps"),
    ("panel-slice", "slice"),
    ("panel-curve", "curve"),
    ("panel-bits", "bits"),
    ("panel-compare", "compare"),
    ("panel-error", "error"),
    ("panel-plan", "plan"),
];

/// The one of `all` that has that name, or had it once.
pub fn by_name<T: Copy>(
    all: impl IntoIterator<Item = T>,
    name: impl Fn(T) -> &'static str,
    given: &str,
) -> Option<T> {
    let renamed = FORMER.iter().find(|(former, _)| *former == given);
    let wanted = renamed.map_or(given, |(_, now)| now);
    all.into_iter().find(|&one| name(one) == wanted)
}

/// The names that a thing had before its own.
pub fn former_names(name: &str) -> impl Iterator<Item = &'static str> {
    let of_it = FORMER.iter().filter(move |(_, now)| *now == name);
    of_it.map(|&(former, _)| former)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_was_given_up_is_still_understood() {
        let all = ["half", "tutorial"];
        let find = |given| by_name(all, |name| name, given);
        assert_eq!(find("tutorial"), Some("tutorial"));
        assert_eq!(find("seed"), Some("tutorial"));
        assert_eq!(find("sown"), None);
        assert!(former_names("tutorial").eq(["seed"]));
        assert!(former_names("half").next().is_none());
    }
}
