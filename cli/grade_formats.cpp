#include "cli/grade_formats.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/messages.h"
#include "core/did_you_mean.h"
#include "core/text.h"

namespace farol::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> namesOfFormats() {
    std::vector<std::string> names;
    for (const grade::Format& format : grade::formats()) names.emplace_back(format.name);
    return names;
}

/// Writes a file through a stream, all or nothing.
void writeStream(const std::string& path, const std::function<void(std::ostream&)>& write) {
    const std::string draft = path + ".part";
    std::ofstream out(draft, std::ios::binary);
    write(out);
    out.close();
    std::error_code failed;
    if (out) fs::rename(draft, path, failed);
    if (!out || failed)
        throw OutputError(message<"output.unwritable">(
            "path"_arg = uncut(path), "reason"_arg = failed ? failed.message() : "write error"));
}

/// A submission's id as the name of a folder: no separator, no hidden and no parent folder.
std::string folderNameOf(const std::string& id, std::set<std::string>& taken) {
    std::string name = id;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '/' || c == '\\' || c == ':'; }, '_');
    constexpr std::size_t kMaxBytes = 200;
    while (name.size() > kMaxBytes) name.pop_back();
    name = toUtf8(name);
    if (name.empty() || name.front() == '.') name.insert(name.begin(), '_');
    std::string unique = name;
    for (int i = 2; !taken.insert(unique).second; ++i) unique = name + "-" + std::to_string(i);
    return unique;
}

grade::FormatContext contextOf(const std::vector<const grade::Format*>& chosen) {
    grade::FormatContext context;
    for (const grade::Format* format : chosen)
        for (const std::string_view name : split(format->environment)) {
            const char* value = std::getenv(std::string(name).c_str());
            if (value != nullptr) context.environment[std::string(name)] = toUtf8(value);
        }
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    context.utc = text;
    return context;
}

}  // namespace

std::string formatWords() { return joined(namesOfFormats(), "|"); }

std::vector<const grade::Format*> chooseFormats(const std::vector<std::string>& words) {
    for (const std::string& word : words)
        if (grade::findFormat(word) == nullptr) {
            const std::string near = didYouMean(word, namesOfFormats());
            throw UsageError(message<"usage/grade-format">(
                "name"_arg = word, "suggestion"_arg = near,
                "known"_arg = uncut(near.empty() ? joined(namesOfFormats(), ", ") : "")));
        }
    std::vector<const grade::Format*> chosen;
    for (const grade::Format& format : grade::formats()) {
        const bool isNamed = std::find(words.begin(), words.end(), format.name) != words.end();
        if (!(words.empty() ? format.isDefault : isNamed)) continue;
        chosen.push_back(&format);
    }
    const grade::FormatContext context = contextOf(chosen);
    for (const grade::Format* format : chosen)
        for (const std::string_view name : split(format->environment))
            if (!context.environment.contains(std::string(name)))
                throw UsageError(message<"usage/format-environment">("format"_arg = format->name,
                                                                     "variable"_arg = name));
    return chosen;
}

void writeFormats(const std::string& folder, const std::vector<const grade::Format*>& chosen,
                  const grade::ClassResult& all, bool isSingle) {
    const grade::FormatContext context = contextOf(chosen);
    std::set<std::string> taken;
    std::vector<const grade::Format*> each;
    for (const grade::Format* format : chosen)
        if (format->ofOne != nullptr)
            each.push_back(format);
        else
            writeStream(folder + "/" + std::string(format->file),
                        [&](std::ostream& out) { format->ofClass(out, all); });
    for (std::size_t i = 0; i < all.count && !each.empty(); ++i) {
        const grade::Outcome outcome = grade::outcomeOf(all, i);
        const std::string name = folderNameOf(outcome.id, taken);
        for (const grade::Format* format : each) {
            std::string place = folder;
            if (!isSingle) place += "/" + std::string(format->name) + "/" + name;
            std::error_code failed;
            fs::create_directories(place, failed);
            if (failed)
                throw OutputError(message<"output.unwritable/folder">(
                    "path"_arg = uncut(place), "reason"_arg = failed.message()));
            writeStream(place + "/" + std::string(format->file),
                        [&](std::ostream& out) { format->ofOne(out, outcome, context); });
        }
    }
}

grade::Agreement writeAgreement(const std::string& folder, const grade::ClassResult& all,
                                const std::vector<grade::PersonMark>& marks,
                                const std::string& file) {
    grade::Agreement agreement = grade::compareMarks(all, marks, file);
    writeStream(folder + "/agreement.html",
                [&](std::ostream& out) { grade::writeAgreementPage(out, agreement); });
    writeStream(folder + "/agreement.json",
                [&](std::ostream& out) { grade::writeAgreementJson(out, agreement); });
    return agreement;
}

}  // namespace farol::cli
