// What a light type is, by the interface that it has (light_type.h).
#pragma once
#include <tuple>
#include <type_traits>
#include <variant>

#include "light/types/registry.h"

namespace etendue {

template <class Type>
concept HasEmitter = requires {
  typename Type::Emitter;
};

template <class Type>
concept HasSurface = requires(const Type& type) {
  type.shape();
};

template <class Type>
concept HasAnalyticShape = HasSurface<Type> && requires {
  Type::kShape;
};

namespace light_type_detail {

template <class Type>
auto emitter_tuple() {
  if constexpr (HasEmitter<Type>)
    return std::tuple<typename Type::Emitter>();
  else
    return std::tuple<>();
}
template <class... Emitter>
std::variant<Emitter...> variant_of(std::tuple<Emitter...>);
template <class... Type>
auto emitters(LightTypeList<Type...>) {
  return variant_of(std::tuple_cat(emitter_tuple<Type>()...));
}

template <class Result, class F>
Result with_type_of(AnalyticShape::Kind, F&&, LightTypeList<>) {
  return {};
}
template <class Result, class F, class First, class... Rest>
Result with_type_of(AnalyticShape::Kind kind, F&& f, LightTypeList<First, Rest...>) {
  if constexpr (HasAnalyticShape<First>)
    if (First::kShape == kind) return f(std::type_identity<First>());
  return with_type_of<Result>(kind, f, LightTypeList<Rest...>());
}

}  // namespace light_type_detail

// The emitter of any type without extent.
using LightEmitter = decltype(light_type_detail::emitters(LightTypes()));

// f(std::type_identity<Type>()) for the light type with this shape.
template <class Result, class F>
Result with_type_of(AnalyticShape::Kind kind, F&& f) {
  return light_type_detail::with_type_of<Result>(kind, f, LightTypes());
}

}  // namespace etendue
