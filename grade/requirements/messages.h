#pragma once

#include "core/message.h"

namespace farol::grade {

/// Texts about requirements: why an object does not match, how many do.
inline constexpr MessageRow kRequirementMessages[] = {
    {"part.choice/one", "{item}", {"sphere"}},
    {"part.choice/or", "{list} or {last}", {"sphere", "box"}},
    {"part.light/number", "light {number} ({type})", {"1", "point"}},
    {"part.manual/open", "open: a person marks it"},
    {"part.met/all", "{count} found", {"8"}},
    {"part.met/each", "{count} of {needed} match", {"8", "8"}},
    {"part.object/group", "group \"{group}\" (model {number}, {shape})", {"Earth", "4", "sphere"}},
    {"part.object/name", "\"{name}\"", {"Earth"}},
    {"part.object/number", "model {number} ({shape})", {"4", "sphere"}},
    {"part.miss/above", "no object of \"{id}\" hangs from its group", {"moons"}},
    {"part.miss/below", "hangs from the group of no object of \"{id}\"", {"planets"}},
    {"part.miss/buried", "is inside {who}", {"model 1 (sphere)"}},
    {"part.miss/buried-not", "is inside no other object"},
    {"part.miss/curve", "moves along no curve"},
    {"part.miss/curve-align",
     "its curve has align=\"{found}\"; expected \"{expected}\"",
     {"false", "true"}},
    {"part.miss/curve-points",
     "its curve has {count} points; expected {least} or more",
     {"4", "6"}},
    {"part.miss/depth", "stands in {depth} groups; expected {least} to {most}", {"1", "3", "64"}},
    {"part.miss/emissive", "does not shine by itself; give it an emissive colour"},
    {"part.miss/emissive-not", "shines by itself; its emissive colour is not 0"},
    {"part.miss/equal-image", "has the same image as {who}", {"model 2 (sphere)"}},
    {"part.miss/equal-mesh", "has the same mesh as {who}", {"model 2 (sphere)"}},
    {"part.miss/light-lights",
     "{count} of the {visible} visible objects of \"{id}\" change without it; expected half or "
     "more",
     {"0", "8", "planets"}},
    {"part.miss/light-near",
     "stands {distance} from the nearest object of \"{id}\"; expected {most} or less",
     {"12", "sun", "3.6"}},
    {"part.miss/light-near-none", "there is no object of \"{id}\"", {"sun"}},
    {"part.miss/light-type", "is a {found} light; expected {expected}", {"directional", "point"}},
    {"part.miss/light-unseen", "no object of \"{id}\" is visible", {"planets"}},
    {"part.miss/material",
     "its {property} is {value}; expected {least} to {most}",
     {"shininess", "0", "1", "128"}},
    {"part.miss/matters", "its pixels do not change without {effect}", {"texture"}},
    {"part.miss/mesh", "{problem}", {"has 178 triangles; expected 180"}},
    {"part.miss/moves", "stands still; give its group a transform with a time"},
    {"part.miss/moves-not", "moves with the time"},
    {"part.miss/name", "has no name like \"{pattern}\"", {"comet*"}},
    {"part.miss/not", "is one of \"{id}\"", {"moons"}},
    {"part.miss/of", "{who} {reason}", {"model 4 (sphere)", "stands still"}},
    {"part.miss/order",
     "is out of order: its {rising} is {value}, after {before}",
     {"period", "8", "12"}},
    {"part.miss/seen",
     "covers {least} pixels or more at {count} of {times} times; expected {needed}",
     {"20", "0", "2", "2"}},
    {"part.miss/shape", "is a {found}; expected {expected}", {"box", "sphere"}},
    {"part.miss/texture", "has no texture"},
    {"part.miss/texture-file",
     "its image \"{file}\" is not in the submission, or cannot be read",
     {"mars.jpg"}},
    {"part.miss/texture-not", "has a texture"},
    {"part.miss/turns", "no rotation with a time acts on it"},
    {"part.miss/turns-not", "a rotation with a time acts on it"},
    {"part.miss/turns-about", "does not go round any object of \"{id}\"", {"sun"}},
    {"part.unmet/each-none", "there is no object of \"{id}\"", {"planets"}},
    {"part.unmet/none", "none found"},
    {"part.unmet/some", "{count} of {needed} found", {"7", "8"}},
    {"part.unmet/many", "{count} found; expected {most} or less", {"3", "1"}},
    {"requirement.partly",
     "partly met: {text} ({reason})[; {miss}]",
     {"Eight planets turn about the sun", "7 of 8 found", "model 4 (sphere) stands still"}},
    {"requirement.unmet",
     "not met: {text} ({reason})[; {miss}]",
     {"A moon below a planet", "none found", "model 9 (sphere) hangs from the group of no object"}},
};

/// A message of the table above.
template <FixedString kId, FixedString... kNames>
Message requirementMessage(const NamedArgument<kNames>&... arguments) {
    return makeMessage<kId, kRequirementMessages>(arguments...);
}

}  // namespace farol::grade
