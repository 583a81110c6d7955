#include <cmath>

#include "plants.h"

namespace farol::test {
namespace {

Share lightMissing(Sheet& s, Work&, Dice& d, int) {
    const std::vector<std::size_t> lights = s.free("light");
    if (lights.size() < 2) return {};
    const std::size_t line = lights[d.below(lights.size())];
    s.cut(line, line);
    return 0.5;
}
Share lightNegated(Sheet& s, Work&, Dice& d, int p) {
    const auto done = changeOne(s, d, p, "light", [&](std::size_t l) {
        if (!s.number(l, "dirX")) return false;
        for (const char* axis : {"dirX", "dirY", "dirZ"}) s.set(l, axis, -*s.number(l, axis));
        return true;
    });
    return done ? Share(0.8) : done;
}
Share lightDirection(Sheet& s, Work&, Dice& d, int p) {
    const auto done = changeOne(s, d, p, "light", [&](std::size_t l) {
        if (!s.number(l, "dirX")) return false;
        const double x = *s.number(l, "dirX"), z = *s.number(l, "dirZ");
        if (std::abs(x - z) < 0.3) return false;
        s.set(l, "dirX", z);
        s.set(l, "dirZ", x);
        return true;
    });
    return done ? Share(0.4) : done;
}
Share lightPosition(Sheet& s, Work&, Dice& d, int p) {
    const auto done = changeOne(s, d, p, "light", [&](std::size_t l) {
        const auto x = s.number(l, "posX");
        if (!x || std::abs(*x) < 0.3) return false;
        s.set(l, "posX", -*x);
        return true;
    });
    return done ? Share(0.3) : done;
}
Share lightColor(Sheet& s, Work&, Dice& d, int p) {
    const auto done = changeOne(s, d, p, "light", [&](std::size_t l) {
        const auto r = s.number(l, "diffR"), b = s.number(l, "diffB");
        if (!r || !b) return false;
        s.set(l, "diffR", std::abs(*r - *b) > 0.2 ? *b : 0.25 * *r);
        s.set(l, "diffB", *r);
        return true;
    });
    return done ? Share(0.3) : done;
}
Share lightAttenuation(Sheet& s, Work&, Dice& d, int p) {
    const auto done = changeOne(s, d, p, "light", [&](std::size_t l) {
        if (!s.number(l, "posX")) return false;
        s.set(l, "quadratic", *s.number(l, "quadratic") + 0.3);
        return true;
    });
    return done ? Share(0.3) : done;
}
Share spotCutoff(Sheet& s, Work&, Dice& d, int p) {
    const auto done = changeOne(s, d, p, "light", [&](std::size_t l) {
        if (s.word(l, "type") != "spot" || *s.number(l, "cutoff") >= 90.0) return false;
        s.set(l, "cutoff", *s.number(l, "cutoff") * 0.5);
        return true;
    });
    return done ? Share(0.3) : done;
}

bool isLit(const Sheet& s) {
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s.is(i, "light")) return true;
    return false;
}
/// Changes the element of a material of one model; `line` of `each` is the element's.
template <typename Each>
Share changeMaterial(Sheet& s, Dice& d, int p, const std::string& tag, Each each) {
    if (!isLit(s)) return {};
    std::vector<std::size_t> models = s.free("model");
    while (!models.empty()) {
        const std::size_t at = d.below(models.size());
        const std::size_t model = models[at];
        models.erase(models.begin() + static_cast<std::ptrdiff_t>(at));
        for (std::size_t l = model; l <= s.endOf(model); ++l) {
            if (!s.is(l, tag) || !each(l)) continue;
            s.markAll(model, s.endOf(model), p);
            return oneModel(s);
        }
    }
    return {};
}
Share otherColor(Sheet& s, Work&, Dice& d, int p) {
    return changeMaterial(s, d, p, "diffuse", [&](std::size_t l) {
        const auto r = s.number(l, "R"), g = s.number(l, "G"), b = s.number(l, "B");
        if (!r || !g || !b) return false;
        s.set(l, "R", *b);
        s.set(l, "G", *r);
        s.set(l, "B", 1.0 - *g);
        return true;
    });
}
Share smallColors(Sheet& s, Work&, Dice& d, int p) {
    return changeMaterial(s, d, p, "color", [&](std::size_t color) {
        bool any = false;
        for (std::size_t l = color; l < s.endOf(color); ++l)
            for (const char* tag : {"diffuse", "ambient", "specular"})
                if (s.is(l, tag) && s.number(l, "R"))
                    for (const char* channel : {"R", "G", "B"}) {
                        any = any || *s.number(l, channel) > 0.1;
                        s.set(l, channel, *s.number(l, channel) / 255.0);
                    }
        return any;
    });
}
Share noSpecular(Sheet& s, Work&, Dice&, int p) {
    if (!isLit(s)) return {};
    double share = 0.0;
    for (const std::size_t model : s.free("model"))
        for (std::size_t l = model; l <= s.endOf(model); ++l) {
            if (!s.is(l, "specular") || !s.number(l, "R") ||
                *s.number(l, "R") + *s.number(l, "G") + *s.number(l, "B") < 0.1)
                continue;
            for (const char* channel : {"R", "G", "B"}) s.set(l, channel, 0.0);
            s.markAll(model, s.endOf(model), p);
            share += oneModel(s);
            break;
        }
    return share > 0.0 ? Share(share) : Share();
}
Share shininess(Sheet& s, Work&, Dice& d, int p) {
    return changeMaterial(s, d, p, "color", [&](std::size_t color) {
        std::size_t at = 0;
        bool shines = false;
        for (std::size_t l = color; l < s.endOf(color); ++l) {
            if (s.is(l, "specular") && s.number(l, "R")) shines = *s.number(l, "R") > 0.1;
            if (s.is(l, "shininess")) at = l;
        }
        if (!shines || at == 0) return false;
        s.set(at, "value", *s.number(at, "value") > 12.0 ? 2.0 : 100.0);
        return true;
    });
}

Share textureMissing(Sheet& s, Work&, Dice& d, int p) {
    for (const std::size_t model : s.free("model")) {
        if (d.below(2) == 0) continue;
        for (std::size_t l = model; l <= s.endOf(model); ++l) {
            if (!s.is(l, "texture")) continue;
            if (l + 1 < s.size() && s.is(l + 1, "texgen")) break;
            s.cut(l, l);
            s.markAll(model, s.endOf(model), p);
            return oneModel(s);
        }
    }
    return {};
}
Share textureWrong(Sheet& s, Work&, Dice& d, int p) {
    const std::vector<std::size_t> lines = s.free("texture");
    if (lines.size() < 2) return {};
    const std::size_t line = lines[d.below(lines.size())];
    for (const std::size_t other : lines) {
        const std::string file = s.word(other, "file");
        if (file == s.word(line, "file") || file.starts_with("chess") ||
            s.word(line, "file").starts_with("chess"))
            continue;
        s.set(line, "file", file);
        s.mark(line, p);
        return oneModel(s);
    }
    return {};
}
Share textureFilter(Sheet& s, Work&, Dice& d, int p) {
    const auto done = changeOne(s, d, p, "texture", [&](std::size_t l) {
        if (s.word(l, "filter") == "nearest") return false;
        s.set(l, "filter", std::string("nearest"));
        return true;
    });
    return done ? Share(oneModel(s)) : done;
}

Share cameraPosition(Sheet& s, Work&, Dice& d, int p) {
    const auto done = changeOne(s, d, p, "position", [&](std::size_t l) {
        s.set(l, "x", *s.number(l, "x") * 0.7 + 0.9);
        s.set(l, "y", *s.number(l, "y") * 1.3 + 0.5);
        return true;
    });
    return done ? Share(0.5) : done;
}
Share cameraTarget(Sheet& s, Work&, Dice& d, int p) {
    const auto done = changeOne(s, d, p, "lookAt", [&](std::size_t l) {
        s.set(l, "x", *s.number(l, "x") + 0.9);
        return true;
    });
    return done ? Share(0.5) : done;
}
Share fieldOfView(Sheet& s, Work&, Dice& d, int p) {
    const auto done = changeOne(s, d, p, "projection", [&](std::size_t l) {
        s.set(l, "fov", std::min(120.0, *s.number(l, "fov") * 1.35));
        return true;
    });
    return done ? Share(0.5) : done;
}

}  // namespace

std::vector<Plant> dressPlants() {
    return {
        {"light left out", {"light.missing"}, 5, 20, false, true, lightMissing},
        {"direction negated", {"light.direction-negated"}, 6, 20, true, false, lightNegated},
        {"direction of a light", {"light.direction"}, 4, 18, true, false, lightDirection},
        {"light moved", {"light.position"}, 4, 18, true, false, lightPosition},
        {"colour of a light", {"light.color"}, 3, 14, true, false, lightColor},
        {"attenuation", {"light.attenuation"}, 3, 12, true, false, lightAttenuation},
        {"spot cutoff", {"light.cutoff"}, 3, 12, true, false, spotCutoff},
        {"another colour", {"material.color"}, 3, 16, true, false, otherColor},
        {"colours 0..1 for 0..255", {"material.scale"}, 5, 22, true, false, smallColors},
        {"specular left out everywhere", {"material.missing"}, 4, 16, true, false, noSpecular},
        {"shininess", {"material.shininess"}, 2, 10, true, false, shininess},
        {"texture left out", {"texture.missing"}, 4, 20, true, false, textureMissing},
        {"wrong texture", {"texture.wrong"}, 4, 18, true, false, textureWrong},
        {"mipmaps off", {"texture.filter"}, 1, 6, true, false, textureFilter},
        {"camera moved", {"camera.position"}, 4, 12, true, false, cameraPosition},
        {"camera looks elsewhere", {"camera.target"}, 4, 12, true, false, cameraTarget},
        {"field of view", {"camera.fov"}, 3, 12, true, false, fieldOfView},
    };
}

}  // namespace farol::test
