#pragma once

#include <memory>

#include "render/gl/context.h"

namespace farol::render::gl {

std::unique_ptr<Context> createOsMesaContext();

}  // namespace farol::render::gl
