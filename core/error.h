#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "core/enum_words.h"
#include "core/message.h"

namespace farol {

/// A place in a document: line and column count from 1 (columns in bytes); 0 means unknown.
struct Location {
    std::string file;
    int line = 0;
    int column = 0;
    bool operator==(const Location&) const = default;
};

enum class Severity { info, warning, error };
inline constexpr EnumWords<Severity, Severity::error> kSeverityWords{"info", "warning", "error"};

/// One finding about an input. `code` is stable and public (api/errors.md): "family.word-word".
/// `field` names the request parameter or setting that is wrong, where there is one. `id` and
/// `arguments` are the message's row and values (core/message.h), from which it can be rendered in
/// another language.
struct Diagnostic {
    Severity severity = Severity::error;
    std::string code;
    Location where;
    std::string message;  ///< English
    std::string field;
    std::string id = {};
    MessageArguments arguments = {};
    int count = 1;  ///< of equal findings, at different places; `where` is the first
    bool operator==(const Diagnostic&) const = default;
};

using Diagnostics = std::vector<Diagnostic>;

inline Diagnostic diagnosticOf(Severity severity, Message message, Location where = {},
                               std::string field = {}) {
    Diagnostic result;
    result.severity = severity;
    result.code = message.code();
    result.where = std::move(where);
    result.message = std::move(message.text);
    result.field = std::move(field);
    result.id = std::move(message.id);
    result.arguments = std::move(message.arguments);
    return result;
}

/// The caller's fault, thrown where it is found and caught once at the edge (cli, server).
/// The families of codes:
///   option.*  a picture option or argument       xml.*    the document is not readable XML
///   scene.*   readable XML that is not a scene    asset.*  a file that is missing or unreadable
///   shape.*   a primitive's arguments             mesh.*   a damaged mesh file
///   image.*   a picture that cannot be decoded    limit.*  over a documented bound
/// Holds at least one diagnostic of severity error; warnings found before it travel along.
class Error : public std::runtime_error {
  public:
    explicit Error(Message message, Location where = {}, std::string field = {})
        : Error(Diagnostics{diagnosticOf(Severity::error, std::move(message), std::move(where),
                                         std::move(field))}) {}
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
