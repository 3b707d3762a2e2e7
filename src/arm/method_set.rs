//! [`MethodSet`]: some of the methods of [`Arm`](crate::Arm), for who generates them and for who asks what is generated.

use super::methods::Method;

/// Some of the methods of [`Arm`](crate::Arm).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct MethodSet(u64);

// A bit each.
const _: () = assert!(Method::ALL.len() <= 64);

impl MethodSet {
    /// None of them.
    pub const NONE: Self = Self(0);

    /// Every method.
    pub const ALL: Self = Self::of(Method::ALL);

    /// Those methods; whether one is named once or twice does not matter.
    pub const fn of(methods: &[Method]) -> Self {
        let (mut bits, mut i) = (0, 0);
        while i < methods.len() {
            bits |= 1 << methods[i] as u32;
            i += 1;
        }
        Self(bits)
    }

    /// Whether a method is one of them.
    pub const fn contains(self, method: Method) -> bool {
        self.0 & (1 << method as u32) != 0
    }

    /// The methods that are not among them.
    #[must_use]
    pub const fn rest(self) -> Self {
        Self(Self::ALL.0 & !self.0)
    }

    /// How many there are.
    pub const fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// Whether there is none.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Each once, in the order of the trait.
    pub fn iter(self) -> impl Iterator<Item = Method> {
        let all = Method::ALL.iter().copied();
        all.filter(move |method| self.contains(*method))
    }
}

impl Method {
    /// The method of that name in the trait [`Arm`](crate::Arm).
    pub fn by_name(name: &str) -> Option<Self> {
        let mut all = Self::ALL.iter().copied();
        all.find(|method| method.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_has_what_was_put_in() {
        let set = MethodSet::of(&[
            Method::InverseDynamics,
            Method::MassMatrix,
            Method::MassMatrix,
        ]);
        assert!(set.iter().eq([Method::MassMatrix, Method::InverseDynamics]));
        assert_eq!((set.len(), set.rest().len()), (2, Method::ALL.len() - 2));
        assert!(MethodSet::ALL.rest().is_empty() && MethodSet::NONE.is_empty());
        for method in Method::ALL {
            assert_ne!(set.contains(*method), set.rest().contains(*method));
            assert_eq!(Method::by_name(method.name()), Some(*method));
        }
        assert_eq!(Method::by_name("mass"), None);
    }
}
