#include "scene/assets.h"
