#include "render/options.h"
