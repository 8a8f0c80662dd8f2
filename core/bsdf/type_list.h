// Lists of types, for the closed sets that variants are made of.
#pragma once
#include <tuple>
#include <type_traits>
#include <variant>

namespace etendue {

template <class... T>
struct TypeList {};

// A variant of all types of some tuples, each once, in the order in which they first appear.
template <class Variant, class... Tuples>
struct UniqueVariant {
  using type = Variant;
};
template <class... V, class First, class... Rest, class... Tuples>
struct UniqueVariant<std::variant<V...>, std::tuple<First, Rest...>, Tuples...> {
  static constexpr bool kKnown = (std::is_same_v<First, V> || ...);
  using Grown = std::conditional_t<kKnown, std::variant<V...>, std::variant<V..., First>>;
  using type = typename UniqueVariant<Grown, std::tuple<Rest...>, Tuples...>::type;
};
template <class... V, class... Tuples>
struct UniqueVariant<std::variant<V...>, std::tuple<>, Tuples...> {
  using type = typename UniqueVariant<std::variant<V...>, Tuples...>::type;
};

}  // namespace etendue
