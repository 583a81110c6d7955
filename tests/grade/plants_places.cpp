#include <cmath>
#include <numbers>

#include "plants.h"

namespace farol::test {
namespace {

bool isTurn(const Sheet& sheet, std::size_t line) {
    const auto angle = sheet.number(line, "angle");
    return angle && std::abs(std::fmod(*angle, 90.0)) > 1.0;
}

Share angleSign(Sheet& s, Work&, Dice& d, int p) {
    return changeOne(s, d, p, "rotate", [&](std::size_t l) {
        if (!isTurn(s, l)) return false;
        s.set(l, "angle", -*s.number(l, "angle"));
        return true;
    });
}
Share radians(Sheet& s, Work&, Dice& d, int p) {
    return changeOne(s, d, p, "rotate", [&](std::size_t l) {
        if (!isTurn(s, l) || std::abs(*s.number(l, "angle")) < 8.0) return false;
        s.set(l, "angle", std::round(*s.number(l, "angle") * std::numbers::pi / 180.0 * 1e4) / 1e4);
        return true;
    });
}
/// The same misunderstanding at every joint.
Share radiansEverywhere(Sheet& s, Work&, Dice&, int p) {
    double share = 0.0;
    std::vector<std::size_t> lines;
    for (const std::size_t l : s.free("rotate"))
        if (isTurn(s, l) && std::abs(*s.number(l, "angle")) >= 8.0) lines.push_back(l);
    if (lines.size() < 3) return {};
    for (const std::size_t l : lines) {
        s.set(l, "angle", std::round(*s.number(l, "angle") * std::numbers::pi / 180.0 * 1e4) / 1e4);
        s.mark(l, p);
        share += shareOf(s, l);
    }
    return std::min(1.0, share);
}
Share rotateAxis(Sheet& s, Work&, Dice& d, int p) {
    return changeOne(s, d, p, "rotate", [&](std::size_t l) {
        if (!isTurn(s, l)) return false;
        const std::string x = s.word(l, "x"), y = s.word(l, "y"), z = s.word(l, "z");
        s.set(l, "x", y);
        s.set(l, "y", z);
        s.set(l, "z", x);
        return true;
    });
}
Share rotateValue(Sheet& s, Work&, Dice& d, int p) {
    return changeOne(s, d, p, "rotate", [&](std::size_t l) {
        if (!isTurn(s, l)) return false;
        s.set(l, "angle", *s.number(l, "angle") + 27.0);
        return true;
    });
}

Share translateSign(Sheet& s, Work&, Dice& d, int p) {
    return changeOne(s, d, p, "translate", [&](std::size_t l) {
        for (const char* axis : {"x", "y", "z"}) {
            const auto value = s.number(l, axis);
            if (!value || std::abs(*value) < 0.2) continue;
            s.set(l, axis, -*value);
            return true;
        }
        return false;
    });
}
Share translateAxes(Sheet& s, Work&, Dice& d, int p) {
    return changeOne(s, d, p, "translate", [&](std::size_t l) {
        const auto y = s.number(l, "y"), z = s.number(l, "z");
        if (!y || !z || std::abs(*y - *z) < 0.2 || std::abs(*y + *z) < 0.1) return false;
        s.set(l, "y", *z);
        s.set(l, "z", *y);
        return true;
    });
}
Share translateValue(Sheet& s, Work&, Dice& d, int p) {
    return changeOne(s, d, p, "translate", [&](std::size_t l) {
        const auto x = s.number(l, "x"), z = s.number(l, "z");
        if (!x || !z) return false;
        s.set(l, "x", *x + 0.37);
        s.set(l, "z", *z + 0.23);
        return true;
    });
}
Share scaleTenfold(Sheet& s, Work&, Dice& d, int p) {
    return changeOne(s, d, p, "scale", [&](std::size_t l) {
        for (const char* axis : {"x", "y", "z"})
            if (!s.number(l, axis)) return false;
        for (const char* axis : {"x", "y", "z"}) s.set(l, axis, *s.number(l, axis) * 10.0);
        return true;
    });
}
Share scaleValue(Sheet& s, Work&, Dice& d, int p) {
    return changeOne(s, d, p, "scale", [&](std::size_t l) {
        const auto y = s.number(l, "y");
        if (!y) return false;
        s.set(l, "y", *y * 1.45);
        return true;
    });
}
Share transformMissing(Sheet& s, Work&, Dice& d, int p) {
    std::vector<std::size_t> lines = s.free("scale");
    for (const std::size_t l : s.free("translate"))
        if (s.number(l, "x")) lines.push_back(l);
    if (lines.empty()) return {};
    const std::size_t line = lines[d.below(lines.size())];
    const double share = shareOf(s, line);
    s.cut(line, line);
    (void)p;
    return share;
}
Share order(Sheet& s, Work&, Dice& d, int p) {
    std::vector<std::size_t> firsts;
    for (const char* tag : {"translate", "rotate", "scale"})
        for (const std::size_t l : s.free(tag))
            for (const char* other : {"translate", "rotate", "scale"})
                if (std::string(tag) != other && l + 1 < s.size() && s.is(l + 1, other) &&
                    s.endOf(l) == l && s.endOf(l + 1) == l + 1 && !s.isTouched(l + 1))
                    firsts.push_back(l);
    if (firsts.empty()) return {};
    const std::size_t line = firsts[d.below(firsts.size())];
    s.swapLines(line, line + 1);
    s.mark(line, p);
    s.mark(line + 1, p);
    return shareOf(s, line);
}

Share groupParent(Sheet& s, Work&, Dice& d, int p) {
    std::vector<std::size_t> groups = s.free("group");
    for (int tries = 0; tries < 30 && groups.size() > 2; ++tries) {
        const std::size_t moved = groups[d.below(groups.size())],
                          into = groups[d.below(groups.size())];
        if (s.models(moved) == 0 || (into >= moved && into <= s.endOf(moved)) ||
            s.groupOf(moved) == into || s.groupOf(moved) == s.size())
            continue;
        const double share = static_cast<double>(s.models(moved)) * oneModel(s);
        const std::size_t end = s.endOf(into);
        const std::size_t from = moved, to = s.endOf(moved);
        std::size_t before = end;
        const std::size_t count = to - from + 1;
        std::vector<std::string> block = s.cut(from, to);
        if (before > to) before -= count;
        // The writer's indentation says what closes what.
        const std::string target(1, ' ');
        const std::size_t wanted =
            s.text().empty() ? 0 : 2;  // one step deeper than the closing tag
        const std::size_t closing = [&] {
            std::size_t at = 0;
            std::string all = s.text();
            for (std::size_t n = 0; n < before; ++n) at = all.find('\n', at) + 1;
            return all.find('<', at) - at;
        }();
        const std::size_t has = block.front().find('<');
        for (std::string& line : block) {
            const std::size_t own = line.find('<');
            line = std::string(own - has + closing + wanted, target[0]) + line.substr(own);
        }
        s.paste(before, block, 0);
        s.markAll(before, before + block.size() - 1, p);
        return share;
    }
    return {};
}
Share groupMissing(Sheet& s, Work&, Dice& d, int) {
    std::vector<std::size_t> groups;
    for (const std::size_t l : s.free("group"))
        if (s.models(l) > 0 && static_cast<double>(s.models(l)) * oneModel(s) <= 0.5)
            groups.push_back(l);
    if (groups.empty()) return {};
    const std::size_t line = groups[d.below(groups.size())];
    const double share = static_cast<double>(s.models(line)) * oneModel(s);
    s.cut(line, s.endOf(line));
    return share;
}
Share modelMissing(Sheet& s, Work&, Dice& d, int) {
    const std::vector<std::size_t> models = s.free("model");
    if (models.size() < 3) return {};
    const std::size_t line = models[d.below(models.size())];
    const double share = oneModel(s);
    s.cut(line, s.endOf(line));
    return share;
}
Share groupExtra(Sheet& s, Work&, Dice& d, int p) {
    for (const std::size_t l : s.free("group")) {
        if (s.models(l) != 1 || d.below(2) == 0 || l + 1 >= s.size() || !s.is(l + 1, "transform") ||
            !s.is(l + 2, "translate") || !s.number(l + 2, "x"))
            continue;
        std::vector<std::string> block;
        Sheet copy = s;
        block = copy.cut(l, s.endOf(l));
        const std::size_t at = s.endOf(l) + 1;
        s.paste(at, block, 0);
        s.set(at + 2, "x", *s.number(at + 2, "x") + 1.7);
        s.markAll(at, at + block.size() - 1, p);
        return oneModel(s);
    }
    return {};
}

Share spinDirection(Sheet& s, Work&, Dice& d, int p) {
    return changeOne(s, d, p, "rotate", [&](std::size_t l) {
        if (!s.number(l, "time")) return false;
        s.set(l, "time", -*s.number(l, "time"));
        return true;
    });
}
Share spinTime(Sheet& s, Work&, Dice& d, int p) {
    return changeOne(s, d, p, "rotate", [&](std::size_t l) {
        if (!s.number(l, "time")) return false;
        s.set(l, "time", *s.number(l, "time") * 1.7);
        return true;
    });
}
Share curvePoint(Sheet& s, Work&, Dice& d, int p) {
    for (const std::size_t l : s.free("translate")) {
        if (!s.number(l, "time") || d.below(2) == 0) continue;
        const std::size_t end = s.endOf(l);
        if (end < l + 5) continue;
        s.cut(end - 1, end - 1);
        s.mark(l, p);
        return shareOf(s, l);
    }
    return {};
}

}  // namespace

std::vector<Plant> placePlants() {
    return {
        {"sign of an angle", {"transform.angle-sign"}, 5, 26, true, false, angleSign},
        {"radians for degrees", {"transform.radians"}, 6, 28, true, false, radians},
        {"radians at every joint", {"transform.radians"}, 9, 30, true, false, radiansEverywhere},
        {"axis of a rotation", {"transform.axis"}, 5, 26, true, false, rotateAxis},
        {"another angle", {"transform.value"}, 4, 24, true, false, rotateValue},
        {"sign of a translation", {"transform.sign"}, 5, 26, true, false, translateSign},
        {"coordinates exchanged",
         {"transform.coordinates", "transform.sign", "transform.value"},
         5,
         26,
         true,
         false,
         translateAxes},
        {"another translation", {"transform.value"}, 4, 24, true, false, translateValue},
        {"scale tenfold", {"transform.magnitude"}, 5, 26, true, false, scaleTenfold},
        {"another scale", {"transform.value", "model.arguments"}, 4, 24, true, false, scaleValue},
        {"transform left out",
         {"transform.missing", "transform.value", "model.arguments"},
         5,
         28,
         false,
         true,
         transformMissing},
        {"order of transforms", {"transform.order"}, 6, 30, true, false, order},
        {"group under another group", {"group.parent"}, 6, 30, true, true, groupParent},
        {"group left out", {"group.missing", "model.missing"}, 0, 100, false, true, groupMissing},
        {"model left out", {"model.missing", "group.missing"}, 0, 100, false, true, modelMissing},
        {"group too much", {"model.extra", "group.extra"}, 3, 14, true, true, groupExtra},
        {"turns the other way", {"animation.direction"}, 4, 14, true, false, spinDirection},
        {"turns too slowly", {"animation.time"}, 4, 12, true, false, spinTime},
        {"a point of a curve left out", {"animation.points"}, 4, 16, true, false, curvePoint},
    };
}

}  // namespace farol::test
