// api/openapi.yaml is held against the table of routes, the picture options and the answers.
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "fixture.h"
#include "render/options.h"
#include "tests/support/paths.h"

using namespace farol;
using namespace farol::test;

namespace {

struct Operation {
    std::set<std::string> statuses, parameters;
};

/// The parts of the document that the test needs, read by its indentation (two blanks a level).
struct Document {
    std::map<std::pair<std::string, std::string>, Operation> operations;  ///< by path and method
    std::map<std::string, std::string> parameters;                        ///< name -> its lines
    std::set<std::string> schemas;
    std::set<std::string> references;
};

Document readDocument() {
    std::ifstream file(std::string(farol::test::kSourceDir) + "/api/openapi.yaml");
    REQUIRE(file.good());
    Document out;
    std::string line, top, second, path, method, block, parameter;
    while (std::getline(file, line)) {
        const std::size_t indent = line.find_first_not_of(' ');
        if (indent == std::string::npos || line[indent] == '#') continue;
        std::string key = line.substr(indent, line.find(':') - indent);
        if (const std::size_t at = line.find("'#/"); at != std::string::npos)
            out.references.insert(line.substr(at + 3, line.find('\'', at + 3) - at - 3));
        if (indent == 0) top = key;
        if (indent == 2) second = path = key;
        if (top == "paths") {
            if (indent == 4) method = key;
            if (indent == 6) block = key;
            Operation& operation = out.operations[{path, method}];
            if (block == "responses" && indent == 8) operation.statuses.insert(key.substr(1, 3));
            const std::string reference = "#/components/parameters/";
            if (const std::size_t at = line.find(reference); at != std::string::npos) {
                const std::string name = line.substr(at + reference.size());
                operation.parameters.insert(name.substr(0, name.find('\'')));
            }
            if (block == "parameters" && line.find("- name: ") != std::string::npos)
                operation.parameters.insert(line.substr(line.find(": ") + 2));
        }
        if (top == "components" && second == "parameters") {
            if (indent == 4) parameter = key;
            if (indent > 4) out.parameters[parameter] += line + "\n";
        }
        if (top == "components" && second == "schemas" && indent == 4) out.schemas.insert(key);
    }
    std::erase_if(out.operations, [](const auto& one) { return one.second.statuses.empty(); });
    return out;
}

std::string lower(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
    return text;
}

}  // namespace

TEST_CASE("the document has the routes of the server and no others") {
    FakeServer server;
    const Document document = readDocument();
    std::set<std::pair<std::string, std::string>> routes, documented;
    for (const server::Route& route : server.router().routes())
        routes.emplace(route.pattern, lower(route.method));
    for (const auto& [key, operation] : document.operations) documented.insert(key);
    CHECK(documented == routes);
}

TEST_CASE("the document has every picture option where pictures are made") {
    const Document document = readDocument();
    for (const render::OptionSpec& spec : render::optionSpecs()) {
        INFO(spec.name);
        REQUIRE(document.parameters.count(spec.name) == 1);
        for (const auto& [key, operation] : document.operations) {
            if (operation.parameters.count("width") == 0) continue;
            INFO(key.first);
            // A comparison draws, and its answer is no picture.
            CHECK(operation.parameters.count("onerror") == (key.first == "/v1/compare" ? 0 : 1));
            CHECK(operation.parameters.count(spec.name) == 1);
        }
        // The words of a choice are the ones the option takes.
        if (spec.range.find('|') == std::string::npos) continue;
        std::istringstream words(spec.range.substr(0, spec.range.find(' ')));
        for (std::string word; std::getline(words, word, '|');)
            CHECK(document.parameters.at(spec.name).find(word) != std::string::npos);
    }
    for (const char* path : {"/v1/scenes/{id}/image", "/v1/scenes/{id}/thumbnail"})
        CHECK(document.operations.at({path, "get"}).parameters.count("width") == 1);
    CHECK(document.operations.at({"/v1/render", "post"}).parameters.count("width") == 1);
}

TEST_CASE("the bounds in the document are the bounds of the server") {
    FakeServer server;
    const Document document = readDocument();
    const auto statusOf = [&](const std::string& name, const std::string& value) {
        // A frame's number needs its session.
        const std::string with = name == "seq" ? "session=a&" : "";
        return post(server.port(), "/v1/render?" + with + name + "=" + value, "<world/>").status;
    };
    int checked = 0;
    for (const auto& [name, lines] : document.parameters) {
        const std::size_t low = lines.find("minimum: "), high = lines.find("maximum: ");
        if (low == std::string::npos || high == std::string::npos) continue;
        INFO(name);
        const double min = std::stod(lines.substr(low + 9)),
                     max = std::stod(lines.substr(high + 9));
        const bool whole = lines.find("type: integer") != std::string::npos;
        const auto text = [&](double value) {
            std::ostringstream out;
            out.precision(17);
            out << value;
            return whole ? std::to_string(static_cast<long>(value)) : out.str();
        };
        CHECK(statusOf(name, text(min)) == 200);
        CHECK(statusOf(name, text(max)) == 200);
        CHECK(statusOf(name, text(whole ? min - 1 : min - 1e-3 * std::abs(min) - 1e-9)) == 400);
        CHECK(statusOf(name, text(whole ? max + 1 : max + 1e-3 * std::abs(max) + 1e-9)) == 400);
        ++checked;
    }
    CHECK(checked >= 10);
}

TEST_CASE("every route answers with statuses that the document lists") {
    const TemporaryFolder folder("http-openapi");
    folder.write("box/scene.xml", "<world/>");
    server::ServiceOptions options;
    options.scenesDir = folder.path();
    options.maxBodyBytes = 1000;
    FakeServer server(options);
    const Document document = readDocument();
    int answered = 0;
    for (const auto& [key, operation] : document.operations) {
        std::string target = key.first;
        for (const auto& [name, value] : std::map<std::string, std::string>{
                 {"{id}", "box"}, {"{shape}", "cone"}, {"{file}", "plain.js"}})
            if (const std::size_t at = target.find(name); at != std::string::npos)
                target.replace(at, name.size(), value);
        // store_test.cpp and assignments_test.cpp have their tables.
        if (key.second == "delete" || key.first.starts_with("/v1/assignments")) continue;
        if (key.first == "/v1/scenes/{id}/file") target += "?path=scene.xml";
        const std::string nonsense = target.find('?') == std::string::npos ? "?" : "&";
        const std::string method = key.second == "post" ? "POST" : "GET";
        std::string body = method == "POST" ? "<world/>" : "";
        std::vector<std::pair<std::string, std::string>> type, unacceptable;
        if (key.first == "/v1/grade") {
            body = multipart(
                {{"submission", "s.xml", "<world/>", ""}, {"reference", "r.xml", "<world/>", ""}});
            type.emplace_back("Content-Type", kMultipartType);
        }
        if (key.first == "/v1/compare") {
            body = multipart({{"first", "a.xml", "<world/>", ""}, {"second", "b.png", "x", ""}});
            type.emplace_back("Content-Type", kMultipartType);
        }
        unacceptable = type;
        unacceptable.emplace_back("Accept", "text/nothing");
        std::vector<Ask> probes = {{method, target, type, body},
                                   {method, target + nonsense + "nonsense=1", type, body},
                                   {method, target, unacceptable, body}};
        if (method == "POST") {
            probes.push_back({method, target, {{"Content-Type", "text/plain"}}, body});
            probes.push_back({method, target, {}, std::string(1001, ' ')});
        }
        const std::string tag = get(server.port(), target).header("etag");
        if (!tag.empty()) probes.push_back({method, target, {{"If-None-Match", tag}}, ""});
        if (key.first.find("{id}") != std::string::npos) {
            std::string missing = key.first;
            missing.replace(missing.find("{id}"), 4, "missing");
            probes.push_back({method, missing, {}, ""});
        }
        for (const Ask& probe : probes) {
            const Answer answer = ask(server.port(), probe);
            INFO(key.second << " " << probe.target << " " << answer.status);
            CHECK(operation.statuses.count(std::to_string(answer.status)) == 1);
            ++answered;
        }
        CHECK(ask(server.port(), probes.front()).status == 200);  // once kept, POST says 200 too
        CHECK(operation.statuses.count("400") == 1);
    }
    CHECK(answered > 40);
}

TEST_CASE("what the document refers to is there") {
    const Document document = readDocument();
    for (const std::string& reference : document.references) {
        INFO(reference);
        const std::string name = reference.substr(reference.rfind('/') + 1);
        if (reference.rfind("components/schemas/", 0) == 0)
            CHECK(document.schemas.count(name) == 1);
        if (reference.rfind("components/parameters/", 0) == 0)
            CHECK(document.parameters.count(name) == 1);
    }
    CHECK(document.references.size() > 30);
}
