#include "server/http/body_reader.h"

#include <catch2/catch.hpp>

using farol::server::http::BodyReader;
using State = BodyReader::State;

namespace {

struct Row {
    std::string bytes;
    State state;
    std::string body;
    std::size_t taken;
};

}  // namespace

TEST_CASE("a body in chunks is joined, and ends where it says") {
    const std::string next = "GET /";
    const std::string ff(300, 'x');
    const std::vector<Row> table = {
        {"0\r\n\r\n" + next, State::whole, "", 5},
        {"5\r\nworld\r\n0\r\n\r\n" + next, State::whole, "world", 15},
        {"3\r\nwor\r\n2;name=value\r\nld\r\n00\r\n\r\n", State::whole, "world", 32},
        {"A\r\n0123456789\r\na\r\n0123456789\r\n0\r\n\r\n", State::whole, "01234567890123456789",
         35},
        {"5\r\nwor", State::more, "wor", 6},
        {"5\r\nworld", State::more, "world", 8},
        {"5\r\nworld\r\n0\r\n", State::more, "world", 13},
        {"", State::more, "", 0},
        {"\r\n", State::broken, "", 2},
        {"5 \r\nworld", State::broken, "", 4},
        {"+5\r\nworld", State::broken, "", 4},
        {"-5\r\nworld", State::broken, "", 4},
        {"0x5\r\nworld", State::broken, "", 5},
        {"5\nworld", State::broken, "", 2},
        {"5\rworld", State::broken, "", 3},
        {"5\r\nworlds\r\n", State::broken, "world", 11},
        {"0\r\nTrailer: x\r\n\r\n", State::broken, "", 15},
        {"1;" + ff, State::broken, "", 257},
        {"21\r\n", State::tooLarge, "", 4},
        {"7fffffffffffffff\r\n", State::tooLarge, "", 18},
        {"10000000000000000\r\n", State::tooLarge, "", 19},
        {"10\r\n0123456789abcdef\r\n11\r\n", State::tooLarge, "0123456789abcdef", 26},
    };
    for (const Row& row : table) {
        INFO(row.bytes);
        BodyReader reader(std::nullopt, 32);
        CHECK(reader.feed(row.bytes) == row.taken);
        CHECK(reader.state() == row.state);
        CHECK(reader.take() == row.body);
    }
}

TEST_CASE("a body of a length ends with it") {
    BodyReader reader(5, 5);
    CHECK(reader.state() == State::more);
    CHECK(reader.feed("wor") == 3);
    CHECK(reader.state() == State::more);
    CHECK(reader.feed("ldGET /") == 2);
    CHECK(reader.state() == State::whole);
    CHECK(reader.feed("GET /") == 0);
    CHECK(reader.take() == "world");
    CHECK(BodyReader(6, 5).state() == State::tooLarge);
    CHECK(BodyReader(0, 5).state() == State::whole);
    CHECK(BodyReader(0, 0).state() == State::whole);
    BodyReader cut(5, 5);
    cut.feed("wor");
    cut.giveUp();
    CHECK(cut.state() == State::broken);
}

TEST_CASE("extensions of chunks are bounded in all, chunks are not") {
    BodyReader many(std::nullopt, 1U << 20U);
    std::string chunks;
    for (int i = 0; i < 100'000; ++i) chunks += "1\r\nx\r\n";
    CHECK(many.feed(chunks + "0\r\n\r\n") == chunks.size() + 5);
    CHECK(many.state() == State::whole);
    CHECK(many.size() == 100'000);
    for (const std::string& size : {"1;" + std::string(200, 'e'), std::string(200, '0') + "1"}) {
        BodyReader padded(std::nullopt, 1U << 20U);
        int chunksRead = 0;
        while (padded.state() == State::more && chunksRead < 1000) {
            padded.feed(size + "\r\nx\r\n");
            ++chunksRead;
        }
        CHECK(padded.state() == State::broken);
        CHECK(chunksRead > 50);
        CHECK(chunksRead < 100);
    }
}
