// Debian's libliggghts-dev includes this list of tangential models in its headers but does not ship it.
// Nothing here needs the models themselves, which are compiled into the library.
