#include "cli/report.h"

#include <algorithm>
#include <iostream>
#include <utility>

#include "core/limit_findings.h"
#include "server/request/problem.h"

namespace farol::cli {
std::string formatLine(const Diagnostic& diagnostic, Language language) {
    const Location& where = diagnostic.where;
    std::string line = where.file;
    if (where.line > 0) {
        line += ":" + std::to_string(where.line);
        if (where.column > 0) line += ":" + std::to_string(where.column);
    }
    line += ": " + std::string(kSeverityWords[diagnostic.severity]) + ": " +
            textIn(language, diagnostic);
    // The note about hidden findings has their number in its text.
    if (diagnostic.count > 1 && diagnostic.code != "limit.diagnostics")
        line += " (" + std::to_string(diagnostic.count) + " times)";
    if (!diagnostic.code.empty()) line += " [" + diagnostic.code + "]";
    const auto isControl = [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x20 || byte == 0x7f;
    };
    std::replace_if(line.begin(), line.end(), isControl, '?');
    return line;
}

void Report::add(const Diagnostics& diagnostics) {
    Diagnostics found = json_ || verbose_ ? diagnostics : server::notable(diagnostics);
    for (Diagnostic& finding : found) finding.where.file = fileOf(finding.where.file);
    if (json_ || write_ != nullptr) {
        found_.insert(found_.end(), found.begin(), found.end());
        return;
    }
    limitFindings(found);
    for (const Diagnostic& finding : found) {
        if (printed_ < kMaxFindings) {
            std::cerr << formatLine(finding, language_) << "\n";
            ++printed_;
        } else {
            hidden_ += finding.count;
        }
    }
}

std::string Report::fileOf(const std::string& file) const {
    const std::string& named = file.empty() ? input_ : file;
    if (path_.empty() || named == path_) return named;
    if (named == input_ || named == "farol") return path_;  // the command line's own faults, too
    const std::size_t slash = path_.rfind('/');
    return (slash == std::string::npos ? "" : path_.substr(0, slash + 1)) + named;
}

void Report::fail(Diagnostic fault) {
    fault.where.file = "farol";
    add({std::move(fault)});
}

void Report::finish(int status) {
    if (write_ != nullptr) {
        write_(std::cout, found_);
        std::cout << std::flush;
        return;
    }
    if (!json_) {
        if (hidden_ > 0)
            std::cerr << formatLine(hiddenNote(std::exchange(hidden_, 0), input_), language_)
                      << std::endl;
        return;
    }
    body_["status"] = status;
    server::setDiagnostics(body_, "diagnostics", found_, language_);
    std::cout << server::dump(body_, 2) << std::endl;
}

}  // namespace farol::cli
