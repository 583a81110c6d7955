// The parsers of the HTTP edge: targets, heads, multipart bodies, tags, Accept.
#include <catch2/catch.hpp>
#include <random>

#include "core/error.h"
#include "server/etag.h"
#include "server/http/head.h"
#include "server/http/uri.h"
#include "server/request/media.h"
#include "server/request/multipart.h"
#include "server/request/parameters.h"

using namespace farol;
using namespace farol::server;

TEST_CASE("targets are split and decoded") {
    const auto target = http::parseTarget("/a%20b/c?x=1+2&y=%2B&z&&=v#part");
    REQUIRE(target);
    CHECK(target->path == "/a%20b/c");
    CHECK(target->query == http::Fields{{"x", "1 2"}, {"y", "+"}, {"z", ""}, {"", "v"}});
    CHECK(http::parseTarget("http://host:8080/p?q=1")->path == "/p");
    for (const char* bad : {"", "a", "*", "/%", "/%4", "/%g0", "/%00", "/?a=%0a", "//%7f"})
        CHECK_FALSE(http::parseTarget(bad));
}

TEST_CASE("percent-encoding round trips") {
    const std::string text = "a b/\xC3\xA9&?#%+~";
    CHECK(http::percentEncodePath(text) == "a%20b/%C3%A9%26%3F%23%25%2B~");
    CHECK(http::percentDecode(http::percentEncodePath(text), false) == text);
}

TEST_CASE("headers that the library must not see are removed from the head") {
    const http::Head head = http::checkHead(
        "POST /v1/render?width=3 HTTP/1.1\r\nHost: x\r\nRange: bytes=0-1\r\nREMOTE_ADDR: "
        "1.2.3.4\r\n"
        "Accept-Encoding: gzip\r\nContent-Type: multipart/form-data; boundary=b\r\n"
        "Content-Length: 5\r\nContent-Length: 5\r\nExpect: 100-continue\r\n\r\n");
    REQUIRE_FALSE(head.refusal);
    CHECK(head.cleaned ==
          "POST /v1/render?width=3 HTTP/1.1\r\nHost: x\r\nContent-Length: 5\r\n\r\n");
    CHECK(head.expectsContinue);
    CHECK(head.contentLength == 5U);
    CHECK(head.request.header("content-type") == "multipart/form-data; boundary=b");
    CHECK(head.request.query == http::Fields{{"width", "3"}});
}

TEST_CASE("random heads never do harm") {
    std::mt19937 random(7);
    const std::string alphabet = "GETPOS /:%HTP1.\r\n\r\n\t,;=\"\\az09\x00\xFF";
    for (int i = 0; i < 20'000; ++i) {
        std::string text = "GET / HTTP/1.1\r\nA: b\r\n\r\n";
        for (int edits = 0; edits < 4; ++edits)
            text[random() % text.size()] = alphabet[random() % alphabet.size()];
        const http::Head head = http::checkHead(text);
        // The result is one head and nothing after it.
        if (!head.refusal) CHECK(head.cleaned.find("\r\n\r\n") == head.cleaned.size() - 4);
    }
}

TEST_CASE("filename* of a part comes before filename") {
    const auto nameOf = [](const std::string& parameters) {
        return parseMultipart("--b\r\nContent-Disposition: form-data; name=f; " + parameters +
                                  "\r\n\r\nx\r\n--b--",
                              "b")
            .at(0)
            .fileName;
    };
    CHECK(nameOf("filename=a.png; filename*=UTF-8''ma%C3%A7%C3%A3.png") ==
          "ma\xC3\xA7\xC3\xA3.png");
    CHECK(nameOf("filename*=utf-8'pt'a%20b.png; filename=\"c.png\"") == "a b.png");
    CHECK(nameOf("filename*=ISO-8859-1''%E9.png") == "\xC3\xA9.png");
    for (const char* bad : {"filename*=a.png", "filename*=UTF-8''%zz", "filename*=UTF-8''%C3",
                            "filename*=UTF-8''%", "filename*=x''a"})
        CHECK_THROWS_AS(nameOf(bad), Error);
}

TEST_CASE("multipart bodies are parted") {
    const std::string body =
        "preamble\r\n--b\r\nContent-Disposition: form-data; name=\"scene\"; "
        "filename=\"a \\\"b\\\".xml\"\r\ncontent-type: Text/XML; charset=x\r\n\r\none\r\n--b \r\n"
        "Content-Disposition: form-data; name=plain\r\n\r\n\r\n--b\r\n"
        "Content-Disposition: form-data; filename=f; name=n\r\n\r\nx\r\n-b\r\n\r\n--b--epilogue";
    const auto parts = parseMultipart(body, "b");
    REQUIRE(parts.size() == 3);
    CHECK(parts[0].name == "scene");
    CHECK(parts[0].fileName == "a \"b\".xml");
    CHECK(parts[0].contentType == "text/xml");
    CHECK(parts[0].content == "one");
    CHECK(parts[1].name == "plain");
    CHECK(parts[1].content.empty());
    CHECK(parts[2].name == "n");
    CHECK(boundaryOf("multipart/form-data; boundary=\"b c\"") == std::string("b c"));
    CHECK(boundaryOf("multipart/form-data; charset=x; boundary=b") == std::string("b"));
    for (const char* bad : {"multipart/form-data",
                            "multipart/form-data; boundary=", "multipart/form-data; boundary=\"b"})
        CHECK_FALSE(boundaryOf(bad));
}

TEST_CASE("damaged multipart bodies are refused, whatever the damage") {
    const std::string good =
        "--b\r\nContent-Disposition: form-data; name=\"scene\"\r\n\r\n<world/>\r\n--b--\r\n";
    REQUIRE(parseMultipart(good, "b").size() == 1);
    for (std::size_t cut = 0; cut < good.size() - 4; ++cut) {
        INFO(cut);
        CHECK_THROWS_AS(parseMultipart(good.substr(0, cut), "b"), Error);
    }
    std::mt19937 random(11);
    for (int i = 0; i < 20'000; ++i) {
        std::string text = good;
        text[random() % text.size()] = static_cast<char>(random() % 256);
        std::size_t parts = 0;
        std::string code = "http.multipart";
        try {
            parts = parseMultipart(text, "b").size();
        } catch (const Error& error) {
            code = error.code();
        }
        CHECK(parts <= 1);
        CHECK(code == "http.multipart");
    }
    std::string many;
    for (std::size_t i = 0; i <= kMaxParts; ++i)
        many += "--b\r\nContent-Disposition: form-data; name=x\r\n\r\n\r\n";
    CHECK_THROWS_AS(parseMultipart(many + "--b--", "b"), Error);
}

TEST_CASE("entity tags tell parts and borders apart") {
    CHECK(entityTag({"a", "bc"}) == entityTag({"a", "bc"}));
    CHECK(entityTag({"a", "bc"}) != entityTag({"ab", "c"}));
    CHECK(entityTag({"a", "b"}) != entityTag({"b", "a"}));
    const std::string tag = entityTag({"x"});
    CHECK(matchesTag("W/\"a\" , " + tag, tag));
    CHECK(matchesTag("*", tag));
    CHECK_FALSE(matchesTag(std::nullopt, tag));
    for (const char* other : {"", "\"a\"", ",,", "\"", "W/", "a, b"})
        CHECK_FALSE(matchesTag(std::string(other), tag));
}

TEST_CASE("the most specific range of an Accept header counts") {
    CHECK(acceptedQuality(std::nullopt, "image/png") == 1.0);
    CHECK(acceptedQuality("image/png;q=0.3, */*", "image/png") == 0.3);
    CHECK(acceptedQuality("image/*;q=0.2, */*;q=0.9", "image/png") == 0.2);
    CHECK(acceptedQuality("text/html", "image/png") == 0.0);
    CHECK(acceptedQuality("image/png;q=0", "image/png") == 0.0);
    CHECK(acceptedQuality(" , ;;q=, image/png;Q=0.5", "image/png") == 0.5);
}

TEST_CASE("parameters are checked against the route's own names") {
    const ParameterRules rules{true, true, {"page"}, {{"width", "320"}}};
    const Parameters out =
        readParameters({{"page", "2"}, {"height", "5"}}, rules, R"({"width": 7, "up": [0, 1, 0]})");
    CHECK(out.picture.width == 7);
    CHECK(out.picture.height == 5);
    CHECK(out.picture.up == glm::dvec3(0, 1, 0));
    CHECK(out.ownValue("page") == "2");
    CHECK(out.given == http::Fields{{"height", "5"}, {"up", "0,1,0"}, {"width", "7"}});
    for (const char* bad :
         {"[]", "3", "{", "{\"width\": null}", "{\"eye\": [1, \"a\"]}", "{\"width\": {}}", "\xFF"})
        CHECK_THROWS_AS(readParameters({}, rules, bad), Error);
    const std::string longText(10'000, 'x');
    for (const http::Fields& query :
         {http::Fields{{longText, "1"}}, http::Fields{{"strict", longText}},
          http::Fields{{"width", longText}}}) {
        try {
            readParameters(query, rules);
            FAIL("was accepted");
        } catch (const Error& error) {
            CHECK(std::string(error.what()).size() < 300);
        }
    }
    CHECK_THROWS_AS(wholeNumber("page", "1x", 1, 9), Error);
    CHECK_THROWS_AS(wholeNumber("page", "10", 1, 9), Error);
    CHECK(wholeNumber("page", "9", 1, 9) == 9);
}

TEST_CASE("Accept-Language chooses the language of the highest quality") {
    for (const auto& [header, expected] : std::initializer_list<std::pair<const char*, Language>>{
             {"", Language::en},
             {"pt", Language::pt},
             {"pt-BR, en;q=0.8", Language::pt},
             {"en, pt", Language::en},
             {"de, cs;q=0.5", Language::cs},
             {"de", Language::en},
             {"*", Language::en},
             {"ES-mx", Language::es},
             {"en;q=0.3, es;q=0.7", Language::es},
             {"cs;q=0, es;q=0", Language::en},
             {"cs;q=0.1, es;q=0", Language::cs},
             {"pt ; Q=0.5 , es;q=0.4", Language::pt},
             {",;,=", Language::en},
             {"ptx", Language::en}}) {
        INFO(header);
        CHECK(acceptedLanguage(header) == expected);
    }
}
