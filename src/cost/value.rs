//! An answer in any number system.

/// A value as a route gave it.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// In double precision.
    Double(f64),
    /// In more bits.
    #[cfg(feature = "mp")]
    Long(rug::Float),
    /// A fraction: without any error.
    #[cfg(feature = "mp")]
    Exact(rug::Rational),
    /// An enclosure; its middle stands for it.
    #[cfg(feature = "mp")]
    Enclosed(Box<crate::number::Interval>),
}

impl Value {
    /// The nearest double. **Accuracy**: correctly rounded.
    pub fn to_f64(&self) -> f64 {
        match self {
            Value::Double(value) => *value,
            #[cfg(feature = "mp")]
            Value::Long(value) => value.to_f64(),
            #[cfg(feature = "mp")]
            Value::Exact(value) => crate::number::Scalar::to_f64(value),
            #[cfg(feature = "mp")]
            Value::Enclosed(value) => value.mid().to_f64(),
        }
    }

    /// `log₁₀ |self − other|`, −∞ where the two are equal: an error of a thousand digits has no double.
    ///
    /// **Accuracy**: the difference is rounded once, to 64 bits or more.
    ///
    /// ```
    /// use dalembert::cost::Value;
    /// assert_eq!(Value::Double(3.0).log10_apart(&Value::Double(2.0)), 0.0);
    /// assert_eq!(Value::Double(2.0).log10_apart(&Value::Double(2.0)), f64::NEG_INFINITY);
    /// ```
    pub fn log10_apart(&self, other: &Value) -> f64 {
        #[cfg(feature = "mp")]
        {
            match (self.rational(), other.rational()) {
                (Some(a), Some(b)) => {
                    let apart = rug::Float::with_val(64, a - b).abs();
                    if apart.is_zero() { f64::NEG_INFINITY } else { apart.log10().to_f64() }
                }
                _ => f64::NAN,
            }
        }
        #[cfg(not(feature = "mp"))]
        {
            let (Value::Double(a), Value::Double(b)) = (self, other);
            (a - b).abs().log10()
        }
    }

    #[cfg(feature = "mp")]
    fn rational(&self) -> Option<rug::Rational> {
        match self {
            Value::Double(value) => rug::Rational::from_f64(*value),
            Value::Long(value) => value.to_rational(),
            Value::Exact(value) => Some(value.clone()),
            Value::Enclosed(value) => value.mid().to_rational(),
        }
    }
}

/// A number system whose values can be compared with those of any other.
pub(super) trait Answer {
    fn answer(self) -> Value;
}

impl Answer for f64 {
    fn answer(self) -> Value {
        Value::Double(self)
    }
}

#[cfg(feature = "mp")]
impl Answer for rug::Float {
    fn answer(self) -> Value {
        Value::Long(self)
    }
}

#[cfg(feature = "mp")]
impl Answer for crate::number::Interval {
    fn answer(self) -> Value {
        Value::Enclosed(Box::new(self))
    }
}

#[cfg(feature = "mp")]
impl Answer for rug::Rational {
    fn answer(self) -> Value {
        Value::Exact(self)
    }
}
