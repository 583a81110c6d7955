#include "generator/registry.h"
