#pragma once

#include "scene/files/messages.h"
#include "scene/read/messages.h"
#include "scene/repair/messages.h"

namespace farol::scene {

/// A message of this floor: message<"scene.value/word">("value"_arg = text). Its rooms have a table
/// each (read/messages.h, files/messages.h).
template <FixedString kId, FixedString... kNames>
Message message(const NamedArgument<kNames>&... arguments) {
    return makeMessage<kId, kReadMessages, kRepairMessages, kFilesMessages>(arguments...);
}

}  // namespace farol::scene
