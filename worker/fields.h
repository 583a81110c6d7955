#pragma once

#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

/// Enumerates the members of plain structures at compile time; structures need no field lists.
namespace farol::worker {

/// Most members of one structure.
inline constexpr std::size_t kMaxFields = 32;

namespace detail {
template <typename T>
inline constexpr bool kIsOptionalField = false;
template <typename T>
inline constexpr bool kIsOptionalField<std::optional<T>> = true;

/// Converts to any member's type, except std::optional, whose own constructor converts it.
struct AnyField {
    template <typename T>
    requires(!kIsOptionalField<T>) operator T() const noexcept;  // never called
};

template <typename T, std::size_t... I>
constexpr bool takes(std::index_sequence<I...>) {
    return requires { T{(static_cast<void>(I), AnyField{})...}; };
}

template <typename T, std::size_t N = kMaxFields>
constexpr std::size_t countFields() {
    if constexpr (takes<T>(std::make_index_sequence<N>{}))
        return N;
    else if constexpr (N > 0)
        return countFields<T, N - 1>();
    else
        return 0;
}
}  // namespace detail

/// How many members an aggregate has; arrays and base classes are not understood.
template <typename T>
inline constexpr std::size_t kFields = detail::countFields<std::remove_const_t<T>>();

/// Calls `use` with all members in their order.
template <typename T, typename Use>
void withFields([[maybe_unused]] T& value, Use&& use) {
    static_assert(std::is_aggregate_v<std::remove_const_t<T>>, "only plain structures travel");
    static_assert(
        !detail::takes<std::remove_const_t<T>>(std::make_index_sequence<kMaxFields + 1>{}),
        "raise kMaxFields");
    constexpr std::size_t kCount = kFields<T>;
    if constexpr (kCount == 0) {
        use();
    } else if constexpr (kCount == 1) {
        auto& [f1] = value;
        use(f1);
    } else if constexpr (kCount == 2) {
        auto& [f1, f2] = value;
        use(f1, f2);
    } else if constexpr (kCount == 3) {
        auto& [f1, f2, f3] = value;
        use(f1, f2, f3);
    } else if constexpr (kCount == 4) {
        auto& [f1, f2, f3, f4] = value;
        use(f1, f2, f3, f4);
    } else if constexpr (kCount == 5) {
        auto& [f1, f2, f3, f4, f5] = value;
        use(f1, f2, f3, f4, f5);
    } else if constexpr (kCount == 6) {
        auto& [f1, f2, f3, f4, f5, f6] = value;
        use(f1, f2, f3, f4, f5, f6);
    } else if constexpr (kCount == 7) {
        auto& [f1, f2, f3, f4, f5, f6, f7] = value;
        use(f1, f2, f3, f4, f5, f6, f7);
    } else if constexpr (kCount == 8) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8);
    } else if constexpr (kCount == 9) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9);
    } else if constexpr (kCount == 10) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10);
    } else if constexpr (kCount == 11) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11);
    } else if constexpr (kCount == 12) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12);
    } else if constexpr (kCount == 13) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13);
    } else if constexpr (kCount == 14) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14);
    } else if constexpr (kCount == 15) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15);
    } else if constexpr (kCount == 16) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16);
    } else if constexpr (kCount == 17) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17);
    } else if constexpr (kCount == 18) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18] =
            value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18);
    } else if constexpr (kCount == 19) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18,
               f19] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19);
    } else if constexpr (kCount == 20) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
               f20] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
            f20);
    } else if constexpr (kCount == 21) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
               f20, f21] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
            f20, f21);
    } else if constexpr (kCount == 22) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
               f20, f21, f22] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
            f20, f21, f22);
    } else if constexpr (kCount == 23) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
               f20, f21, f22, f23] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
            f20, f21, f22, f23);
    } else if constexpr (kCount == 24) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
               f20, f21, f22, f23, f24] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
            f20, f21, f22, f23, f24);
    } else if constexpr (kCount == 25) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
               f20, f21, f22, f23, f24, f25] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
            f20, f21, f22, f23, f24, f25);
    } else if constexpr (kCount == 26) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
               f20, f21, f22, f23, f24, f25, f26] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
            f20, f21, f22, f23, f24, f25, f26);
    } else if constexpr (kCount == 27) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
               f20, f21, f22, f23, f24, f25, f26, f27] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
            f20, f21, f22, f23, f24, f25, f26, f27);
    } else if constexpr (kCount == 28) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
               f20, f21, f22, f23, f24, f25, f26, f27, f28] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
            f20, f21, f22, f23, f24, f25, f26, f27, f28);
    } else if constexpr (kCount == 29) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
               f20, f21, f22, f23, f24, f25, f26, f27, f28, f29] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
            f20, f21, f22, f23, f24, f25, f26, f27, f28, f29);
    } else if constexpr (kCount == 30) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
               f20, f21, f22, f23, f24, f25, f26, f27, f28, f29, f30] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
            f20, f21, f22, f23, f24, f25, f26, f27, f28, f29, f30);
    } else if constexpr (kCount == 31) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
               f20, f21, f22, f23, f24, f25, f26, f27, f28, f29, f30, f31] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
            f20, f21, f22, f23, f24, f25, f26, f27, f28, f29, f30, f31);
    } else if constexpr (kCount == 32) {
        auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
               f20, f21, f22, f23, f24, f25, f26, f27, f28, f29, f30, f31, f32] = value;
        use(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19,
            f20, f21, f22, f23, f24, f25, f26, f27, f28, f29, f30, f31, f32);
    }
}

}  // namespace farol::worker
