#pragma once

#include "core/error.h"

/// Errors of the stand-ins that tests put in place of a renderer, a store or a request's body.
namespace farol::test {

/// An error of one diagnostic that no message table holds: its code and text are the test's own.
inline Error errorOf(const std::string& code, const std::string& text, const Location& where = {}) {
    Diagnostic one;
    one.code = code;
    one.message = text;
    one.where = where;
    return Error(Diagnostics{one});
}

}  // namespace farol::test
