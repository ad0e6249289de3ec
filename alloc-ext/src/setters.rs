//! The setters of options: one line each.

/// Methods that set a field and return the options. Those of `optional` fields take a value, or an
/// `Option` whose `None` is the default.
macro_rules! setters {
    ($($(#[$doc:meta])* $name:ident: $value:ty => $($field:ident).+,)*) => {
        $(
            $(#[$doc])*
            #[must_use]
            pub const fn $name(mut self, value: $value) -> Self {
                self.$($field).+ = value;
                self
            }
        )*
    };
    (optional $($(#[$doc:meta])* $name:ident: $value:ty => $($field:ident).+,)*) => {
        $(
            $(#[$doc])*
            pub fn $name(mut self, value: impl Into<Option<$value>>) -> Self {
                self.$($field).+ = value.into();
                self
            }
        )*
    };
}
