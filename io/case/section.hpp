#pragma once

#include <cstddef>
#include <memory>
#include <utility>

namespace boresight::io {

/// A part of a case behind a pointer: sources that hold a case, but do not read this part, need not
/// know its type T and are not compiled again when T changes. It behaves as a member: a copy has a
/// T of its own, and a constant section gives a constant T. A moved-from section may only be
/// assigned to or destroyed.
template <class T>
class Section {
 public:
  Section() : content_(std::make_unique<T>()) {}
  Section(const Section& other)
      : content_(other.content_ ? std::make_unique<T>(*other.content_) : nullptr) {}
  Section(Section&&) noexcept = default;
  ~Section() = default;
  Section& operator=(const Section& other) {
    if (this != &other) *this = Section(other);
    return *this;
  }
  Section& operator=(Section&&) noexcept = default;
  Section& operator=(T content) {
    content_ = std::make_unique<T>(std::move(content));
    return *this;
  }

  T& operator*() noexcept { return *content_; }
  const T& operator*() const noexcept { return *content_; }
  T* operator->() noexcept { return content_.get(); }
  const T* operator->() const noexcept { return content_.get(); }

 protected:
  explicit Section(std::nullptr_t) {}
  std::unique_ptr<T> content_;
};

/// A section that a case may lack, with std::optional's interface.
template <class T>
class OptionalSection : public Section<T> {
 public:
  OptionalSection() : Section<T>(nullptr) {}
  using Section<T>::operator=;

  bool has_value() const noexcept { return this->content_ != nullptr; }
  explicit operator bool() const noexcept { return has_value(); }
  void reset() noexcept { this->content_.reset(); }
  T& emplace() {
    *this = T{};
    return **this;
  }
};

}  // namespace boresight::io
