// Lists of types, from which the closed sets of lobes and models are built.
#pragma once
#include <tuple>
#include <type_traits>
#include <variant>

namespace etendue {

template <class... T>
struct TypeList {};

// `type` is the variant with the types of all tuples appended, each once, in the order of their first appearance.
template <class Variant, class... Tuples>
struct UniqueVariant {
  using type = Variant;
};
template <class... V, class First, class... Rest, class... Tuples>
struct UniqueVariant<std::variant<V...>, std::tuple<First, Rest...>, Tuples...> {
  static constexpr bool kContained = (std::is_same_v<First, V> || ...);
  using Extended = std::conditional_t<kContained, std::variant<V...>, std::variant<V..., First>>;
  using type = typename UniqueVariant<Extended, std::tuple<Rest...>, Tuples...>::type;
};
template <class... V, class... Tuples>
struct UniqueVariant<std::variant<V...>, std::tuple<>, Tuples...> {
  using type = typename UniqueVariant<std::variant<V...>, Tuples...>::type;
};

}  // namespace etendue
