#pragma once
#include <cstddef>
#include <new>
#include <vector>

namespace dashpot {

/// Allocates on cache lines, for arrays that the kernel reads by whole lines.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{64};
  CacheLineAllocator() = default;
  template <class Other>
  CacheLineAllocator(const CacheLineAllocator<Other>&) {}  // NOLINT(google-explicit-constructor)
  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), kAlignment));
  }
  void deallocate(T* at, std::size_t) { ::operator delete(at, kAlignment); }
  bool operator==(const CacheLineAllocator&) const { return true; }
};
template <class Real>
using AlignedVector = std::vector<Real, CacheLineAllocator<Real>>;

}  // namespace dashpot
