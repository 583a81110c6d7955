#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/language.h"

namespace farol::cli {

/// Findings of a subcommand: as lines on stderr while it runs, or as one JSON object on stdout at
/// its end. The object has `status` (the exit code), `diagnostics`, and the entries of `set`.
class Report {
  public:
    /// From then on nothing is written before `finish`.
    void useJson() { json_ = true; }
    bool json() const { return json_; }
    /// From then on nothing is written before `finish`, which writes the diagnostics by it; `path`
    /// is that of the input, and files beside it are named by the same folder.
    void useWriter(void (*write)(std::ostream&, const Diagnostics&), std::string path) {
        write_ = write;
        path_ = std::move(path);
    }
    /// Without it, diagnostics of severity info are not shown as lines; JSON holds all.
    void setVerbose(bool verbose) { verbose_ = verbose; }

    /// Texts are in this language from then on.
    void setLanguage(Language language) { language_ = language; }
    Language language() const { return language_; }

    /// Sets the file of diagnostics that name none.
    void setInput(const std::string& name) { input_ = name; }
    void add(const Diagnostics& diagnostics);
    /// Adds an error that is in no file: of the command line or of the machine.
    void fail(Diagnostic fault);
    void fail(Message message) { fail(diagnosticOf(Severity::error, std::move(message))); }
    void set(const std::string& key, nlohmann::json value) { body_[key] = std::move(value); }
    /// Sets every entry of an object, except `diagnostics`: finish() writes the added ones.
    void merge(const nlohmann::json& object) { body_.update(object); }
    void finish(int status);

  private:
    /// The input where `file` is empty; for a writer, the path.
    std::string fileOf(const std::string& file) const;

    bool json_ = false;
    void (*write_)(std::ostream&, const Diagnostics&) = nullptr;
    bool verbose_ = false;
    Language language_ = Language::en;
    std::string input_ = "farol";
    std::string path_;  ///< for a writer
    nlohmann::json body_ = nlohmann::json::object();
    Diagnostics found_;  ///< kept for JSON and a writer alone
    std::size_t printed_ = 0;
    int hidden_ = 0;  ///< findings over the limit, which were not printed
};

/// `file:line:column: severity: message [code]`; the numbers only where they are known. Control
/// characters become '?', so that a file cannot write to the terminal.
std::string formatLine(const Diagnostic& diagnostic, Language language = Language::en);

}  // namespace farol::cli
