//! Enums whose variants have a name in output.

/// The enum, its `name` and its `Display`: a line a variant.
macro_rules! named {
    ($(#[$about:meta])* $public:vis enum $Name:ident {
        $($(#[$what:meta])* $Variant:ident = $name:literal,)+
    }) => {
        $(#[$about])*
        $public enum $Name {
            $($(#[$what])* $Variant,)+
        }

        impl $Name {
            /// The name in output.
            $public fn name(self) -> &'static str {
                match self {
                    $($Name::$Variant => $name),+
                }
            }
        }

        impl std::fmt::Display for $Name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(self.name())
            }
        }
    };
}
