#pragma once

#include "engine/core/random.h"
#include "plugins/cosserat/model/rod_model.h"

/// Plants reduced to what is next to what: elements with nothing but a parent, and welds.
namespace pedicel::cosserat::cases {

inline void connect(RodModel& model, int a, int b) {
  Weld weld;
  weld.a = a;
  weld.b = b;
  model.welds.push_back(weld);
}

inline int add_bare(RodModel& model, int parent) {
  Element element;
  element.parent = parent;
  model.elements.push_back(element);
  return model.size() - 1;
}

/// A random tree, up to three elements of it at the clamp, with welds between any two elements
/// (twice between the same two now and then, and between an element and its parent).
inline RodModel random_graph(Random& random, int elements, int welds) {
  RodModel model;
  for (int e = 0; e < elements; ++e) add_bare(model, e < 3 ? -1 : random.integer(0, e - 1));
  for (int w = 0; w < welds; ++w) {
    const int a = random.integer(0, elements - 1);
    connect(model, a, (a + random.integer(1, elements - 1)) % elements);
  }
  return model;
}

/// Two chains of `n` elements from the clamp, tied together at every `every`-th one: a stem on its
/// stake.
inline RodModel staked_stem(int n, int every) {
  RodModel model;
  for (int e = 0; e < 2 * n; ++e) add_bare(model, e % n == 0 ? -1 : e - 1);
  for (int e = every - 1; e < n; e += every) connect(model, e, n + e);
  return model;
}

/// A stem with a leaf at each of its elements: a midrib of four, a rim of four on each side.
inline RodModel leafy_stem(int leaves) {
  RodModel model;
  for (int e = 0; e < leaves; ++e) add_bare(model, e - 1);
  for (int foot = 0; foot < leaves; ++foot) {
    int midrib = foot, left = foot, right = foot;
    for (int i = 0; i < 4; ++i) {
      midrib = add_bare(model, midrib);
      left = add_bare(model, left);
      right = add_bare(model, right);
      connect(model, midrib, left);
      connect(model, midrib, right);
    }
  }
  return model;
}

}  // namespace pedicel::cosserat::cases
