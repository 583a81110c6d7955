#include "grade/requirements/mesh_files.h"

#include "core/text.h"
#include "generator/call.h"
#include "generator/compare/mesh_check.h"
#include "generator/registry.h"
#include "grade/requirements/messages.h"
#include "grade/requirements/select.h"

namespace farol::grade {

int countFiles(const MeshSelector& selector, const scene::Assets& files,
               std::vector<RequiredThing>& matches, std::vector<RequiredThing>& misses) {
    constexpr int kMaxFiles = 64;
    constexpr std::size_t kMaxMisses = 24, kMaxOfFile = 6;
    const std::vector<std::string_view> words = split(selector.shape);
    const generator::Mesh expected =
        generator::generate(generator::parseCall({words.begin(), words.end()}), files);
    int found = 0, tried = 0;
    for (const std::string& path : files.list()) {
        if (!isLike(baseName(path), selector.file) || ++tried > kMaxFiles) continue;
        Diagnostics findings;
        try {
            findings = generator::checkMesh(files.read(path).value_or(""), path, expected).findings;
        } catch (const Error& error) {
            findings = error.diagnostics();
        }
        std::size_t shown = 0;
        bool isRight = true;
        for (const Diagnostic& finding : findings) {
            if (finding.severity != Severity::error) continue;
            isRight = false;
            if (++shown > kMaxOfFile || misses.size() >= kMaxMisses) continue;
            RequiredThing& miss = misses.emplace_back();
            miss.who = requirementMessage<"part.object/name">("name"_arg = uncut(path));
            miss.where = finding.where;
            miss.reason = requirementMessage<"part.miss/mesh">("problem"_arg = finding);
        }
        found += isRight ? 1 : 0;
        if (!isRight || matches.size() >= kShownThings) continue;
        RequiredThing& match = matches.emplace_back();
        match.who = requirementMessage<"part.object/name">("name"_arg = uncut(path));
        match.where.file = path;
    }
    return found;
}

}  // namespace farol::grade
