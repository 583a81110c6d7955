#include "cli/pseudonyms.h"

#include <algorithm>
#include <filesystem>

#include "cli/files.h"
#include "core/digest.h"
#include "core/number.h"
#include "grade/report/csv.h"

namespace farol::cli {
namespace {

constexpr std::string_view kWord = "Student ";

void replaceAll(std::string& text, const std::string& what, const std::string& by) {
    constexpr std::size_t kMinName = 3;  // less would change other words
    if (what.size() < kMinName) return;
    for (std::size_t at = text.find(what); at != std::string::npos;
         at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
}

}  // namespace

Pseudonyms::Pseudonyms(const std::string& keyFile, const std::vector<Submission>& submissions) {
    std::size_t last = 0;
    std::string text = "Pseudonym,Submission,Full name,Identifier\r\n";
    std::error_code failed;
    if (std::filesystem::exists(keyFile, failed)) {
        text = readInput(keyFile);
        const grade::CsvTable table(text, keyFile, {"pseudonym", "submission"});
        for (std::size_t i = 0; i < table.count(); ++i) {
            const std::string pseudonym = table.at(i, "pseudonym");
            byId_[table.at(i, "submission")] = pseudonym;
            if (pseudonym.starts_with(kWord))
                last = std::max(
                    last, parseExact<std::size_t>(pseudonym.substr(kWord.size())).value_or(0));
        }
    }
    std::vector<const Submission*> fresh;
    for (const Submission& one : submissions)
        if (byId_.count(one.id) == 0) fresh.push_back(&one);
    if (fresh.empty()) return;
    std::sort(fresh.begin(), fresh.end(), [](const Submission* a, const Submission* b) {
        return contentDigest(a->id) < contentDigest(b->id);
    });
    if (!text.ends_with('\n')) text += "\r\n";
    for (const Submission* one : fresh) {
        std::string number = std::to_string(++last);
        number.insert(0, 3 - std::min<std::size_t>(3, number.size()), '0');
        const std::string& pseudonym = byId_[one->id] = std::string(kWord) + number;
        text += grade::forCsv(pseudonym) + "," + grade::forCsv(one->id) + "," +
                grade::forCsv(one->name) + "," +
                grade::forCsv(one->number.empty() ? "" : "Participant " + one->number) + "\r\n";
    }
    writeOutput(keyFile, text);
}

const std::string& Pseudonyms::of(const Submission& submission) const {
    return byId_.at(submission.id);
}

std::string withoutName(std::string text, const Submission& submission,
                        const std::string& pseudonym) {
    replaceAll(text, submission.id, pseudonym);
    replaceAll(text, std::filesystem::path(submission.id).stem().string(), pseudonym);
    replaceAll(text, submission.name, pseudonym);
    if (!submission.number.empty())
        replaceAll(text, "_" + submission.number + "_assignsubmission", "_assignsubmission");
    return text;
}

}  // namespace farol::cli
