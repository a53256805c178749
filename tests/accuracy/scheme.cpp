#include "scheme.hpp"

#include "reference_scheme.hpp"
#include "weir_scheme.hpp"

namespace accuracy {

const char* kind_name(Kind kind) {
    switch (kind) {
        case Kind::projection: return "projection";
        case Kind::projection_double: return "projection_double";
        case Kind::equation_of_state: return "equation_of_state";
        case Kind::reference: break;
    }
    return "paper";
}

std::unique_ptr<Scheme> make_scheme(Kind kind) {
    if (kind == Kind::reference) {
        return make_reference();
    }
    return make_weir(kind != Kind::equation_of_state, kind == Kind::projection_double);
}

}  // namespace accuracy
