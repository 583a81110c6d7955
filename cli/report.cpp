#include "cli/report.h"

#include <algorithm>
#include <iostream>
#include <utility>

#include "server/problem.h"

namespace farol::cli {
namespace {

const char* nameOf(Severity severity) {
    switch (severity) {
        case Severity::info:
            return "info";
        case Severity::warning:
            return "warning";
        case Severity::error:
            break;
    }
    return "error";
}

}  // namespace

std::string formatLine(const Diagnostic& diagnostic) {
    const Location& where = diagnostic.where;
    std::string line = where.file;
    if (where.line > 0) {
        line += ":" + std::to_string(where.line);
        if (where.column > 0) line += ":" + std::to_string(where.column);
    }
    line += std::string(": ") + nameOf(diagnostic.severity) + ": " + diagnostic.message;
    if (!diagnostic.code.empty()) line += " [" + diagnostic.code + "]";
    const auto isControl = [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x20 || byte == 0x7f;
    };
    std::replace_if(line.begin(), line.end(), isControl, '?');
    return line;
}

void Report::add(const Diagnostics& diagnostics) {
    for (Diagnostic one : diagnostics) {
        if (one.where.file.empty()) one.where.file = input_;
        if (json_)
            found_.push_back(std::move(one));
        else if (verbose_ || one.severity != Severity::info)
            std::cerr << formatLine(one) << "\n";
    }
}

void Report::fail(const std::string& code, const std::string& message) {
    Diagnostic one;
    one.code = code;
    one.message = message;
    one.where.file = "farol";
    add({one});
}

void Report::finish(int status) {
    if (!json_) return;
    body_["status"] = status;
    body_["diagnostics"] = server::toJson(found_);
    std::cout << server::dump(body_, 2) << std::endl;
}

}  // namespace farol::cli
