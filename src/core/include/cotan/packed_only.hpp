// Rejects aligned default vectors of GLM for interfaces whose library was compiled with packed ones.
#pragma once

#include <type_traits>

#include "cotan/packed.hpp"

static_assert(std::is_same_v<glm::vec3, cotan::packed::vec3>,
              "This part of Cotan takes GLM's packed vectors: include it in files that do not define "
              "GLM_FORCE_DEFAULT_ALIGNED_GENTYPES. GLM's aligned types (glm::aligned_vec3) can be used beside it");
