"""Spaces after Gymnasium's interface, for where it is not installed."""

from typing import Any, Dict as Map, Iterator, Optional, Sequence, Tuple

import numpy as np


class Space:
    """What actions or observations may be."""

    def __init__(self, shape: Optional[Sequence[int]] = None, dtype: Any = None, seed: Any = None):
        self._shape = None if shape is None else tuple(int(n) for n in shape)
        self.dtype = None if dtype is None else np.dtype(dtype)
        self._np_random: Optional[np.random.Generator] = None
        if seed is not None:
            self.seed(seed)

    @property
    def shape(self) -> Optional[Tuple[int, ...]]:
        return self._shape

    @property
    def np_random(self) -> np.random.Generator:
        if self._np_random is None:
            self.seed()
        return self._np_random

    def seed(self, seed: Optional[int] = None) -> int:
        sequence = np.random.SeedSequence(seed)
        self._np_random = np.random.Generator(np.random.PCG64(sequence))
        return sequence.entropy

    @property
    def is_np_flattenable(self) -> bool:
        return True

    def __contains__(self, x: Any) -> bool:
        return self.contains(x)


class Box(Space):
    """Arrays between bounds, both included."""

    def __init__(self, low: Any, high: Any, shape: Optional[Sequence[int]] = None,
                 dtype: Any = np.float32, seed: Any = None):
        if shape is None:
            shape = np.shape(low) or np.shape(high)
        super().__init__(shape, dtype, seed)
        self.low = np.broadcast_to(np.asarray(low, dtype=self.dtype), self._shape).copy()
        self.high = np.broadcast_to(np.asarray(high, dtype=self.dtype), self._shape).copy()
        self.bounded_below = -np.inf < self.low
        self.bounded_above = np.inf > self.high

    def is_bounded(self, manner: str = "both") -> bool:
        below, above = bool(np.all(self.bounded_below)), bool(np.all(self.bounded_above))
        return {"both": below and above, "below": below, "above": above}[manner]

    def sample(self, mask: None = None, probability: None = None) -> np.ndarray:
        random, shape = self.np_random, self._shape
        if self.dtype.kind in "iu":
            return random.integers(self.low.astype(np.int64), self.high.astype(np.int64) + 1,
                                   size=shape).astype(self.dtype)
        below, above = self.bounded_below, self.bounded_above
        x = random.normal(size=shape)
        exponential = random.exponential(size=shape)
        x = np.where(below & ~above, self.low + exponential, x)
        x = np.where(~below & above, self.high - exponential, x)
        low = np.where(below & above, self.low, 0.0)
        high = np.where(below & above, self.high, 1.0)
        x = np.where(below & above, random.uniform(low, high, size=shape), x)
        return x.astype(self.dtype)

    def contains(self, x: Any) -> bool:
        if not isinstance(x, np.ndarray):
            try:
                x = np.asarray(x, dtype=self.dtype)
            except (ValueError, TypeError):
                return False
        return bool(np.can_cast(x.dtype, self.dtype) and x.shape == self._shape
                    and np.all(x >= self.low) and np.all(x <= self.high))

    def __eq__(self, other: Any) -> bool:
        return (isinstance(other, Box) and self._shape == other._shape and self.dtype == other.dtype
                and np.array_equal(self.low, other.low) and np.array_equal(self.high, other.high))

    def __repr__(self) -> str:
        return f"Box({self.low.min()}, {self.high.max()}, {self._shape}, {self.dtype})"


class Dict(Space):
    """Several spaces by name."""

    def __init__(self, spaces: Map[str, Space], seed: Any = None):
        self.spaces = dict(sorted(spaces.items()))
        super().__init__(None, None, seed)

    def seed(self, seed: Optional[int] = None) -> Any:
        super().seed(seed)
        return {name: one.seed(int(self.np_random.integers(2**31))) for name, one in self.spaces.items()}

    def sample(self, mask: None = None, probability: None = None) -> Map[str, Any]:
        return {name: one.sample() for name, one in self.spaces.items()}

    def contains(self, x: Any) -> bool:
        return (isinstance(x, dict) and x.keys() == self.spaces.keys()
                and all(one.contains(x[name]) for name, one in self.spaces.items()))

    def __getitem__(self, name: str) -> Space:
        return self.spaces[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.spaces)

    def __len__(self) -> int:
        return len(self.spaces)

    def keys(self):
        return self.spaces.keys()

    def items(self):
        return self.spaces.items()

    def __eq__(self, other: Any) -> bool:
        return isinstance(other, Dict) and self.spaces == other.spaces

    def __repr__(self) -> str:
        return "Dict(" + ", ".join(f"{name}: {one}" for name, one in self.spaces.items()) + ")"
