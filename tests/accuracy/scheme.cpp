#include "scheme.hpp"

#include "reference_scheme.hpp"
#include "weir_scheme.hpp"

namespace accuracy {

namespace {

struct Description {
    Kind kind;
    const char* name;
    Kind in_float;
    bool projection;
    Format format;
};

constexpr Description kKinds[] = {
    {Kind::projection, "projection", Kind::projection, true, Format::in_float},
    {Kind::projection_double, "projection_double", Kind::projection, true, Format::in_double},
    {Kind::projection_fixed, "projection_fixed", Kind::projection, true, Format::fixed},
    {Kind::projection_small_fixed, "projection_small_fixed", Kind::projection, true,
     Format::small_fixed},
    {Kind::equation_of_state, "equation_of_state", Kind::equation_of_state, false,
     Format::in_float},
    {Kind::equation_of_state_double, "equation_of_state_double", Kind::equation_of_state, false,
     Format::in_double},
    {Kind::equation_of_state_fixed, "equation_of_state_fixed", Kind::equation_of_state, false,
     Format::fixed},
    {Kind::equation_of_state_small_fixed, "equation_of_state_small_fixed", Kind::equation_of_state,
     false, Format::small_fixed},
    {Kind::reference, "paper", Kind::reference, false, Format::in_float},
};

const Description& description(Kind kind) {
    for (const Description& known : kKinds) {
        if (known.kind == kind) {
            return known;
        }
    }
    throw std::logic_error("a scheme without description");
}

}  // namespace

const char* kind_name(Kind kind) {
    return description(kind).name;
}

Kind kind_named(const std::string& name) {
    for (const Description& known : kKinds) {
        if (name == known.name) {
            return known.kind;
        }
    }
    throw std::runtime_error("no scheme of that name: " + name);
}

Kind in_float(Kind kind) {
    return description(kind).in_float;
}

std::unique_ptr<Scheme> make_scheme(Kind kind) {
    const Description& known = description(kind);
    return kind == Kind::reference ? make_reference() : make_weir(known.projection, known.format);
}

}  // namespace accuracy
