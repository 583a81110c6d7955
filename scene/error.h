#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace farol {

/// A place in a document: line and column count from 1 (columns in bytes); 0 means unknown.
struct Location {
    std::string file;
    int line = 0;
    int column = 0;
    bool operator==(const Location&) const = default;
};

enum class Severity { info, warning, error };

/// One finding about an input. `code` is stable and public (api/errors.md): "family.word-word".
/// `field` names a request parameter where the fault is one, else it is empty.
struct Diagnostic {
    Severity severity = Severity::error;
    std::string code;
    Location where;
    std::string message;
    std::string field;
    bool operator==(const Diagnostic&) const = default;
};

using Diagnostics = std::vector<Diagnostic>;

/// The caller's fault, thrown where it is found and caught once at the edge (cli, server).
/// The families of codes and what they mean to a client:
///   option.*  a picture option or argument       xml.*    the document is not readable XML
///   scene.*   readable XML that is not a scene    asset.*  a file that is named but cannot be had
///   shape.*   a primitive's arguments             mesh.*   a damaged mesh file
///   image.*   a picture that cannot be decoded    limit.*  over a documented bound
/// Holds at least one diagnostic of severity error; warnings found before it travel along.
class Error : public std::runtime_error {
  public:
    Error(std::string code, std::string message, Location where = {}, std::string field = {})
        : Error(Diagnostics{{Severity::error, std::move(code), std::move(where), std::move(message),
                             std::move(field)}}) {}
    /// Precondition: `all` holds an error.
    explicit Error(Diagnostics all)
        : std::runtime_error(first(all).message), diagnostics_(std::move(all)) {}

    const Diagnostics& diagnostics() const { return diagnostics_; }
    /// The first diagnostic of severity error: the one that decides the status.
    const Diagnostic& primary() const { return first(diagnostics_); }
    const std::string& code() const { return primary().code; }

  private:
    static const Diagnostic& first(const Diagnostics& all) {
        for (const Diagnostic& one : all)
            if (one.severity == Severity::error) return one;
        return all.front();
    }
    Diagnostics diagnostics_;
};

}  // namespace farol
