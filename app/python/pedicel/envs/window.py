"""A plain window for render_mode="human", by Python's own Tk."""

import numpy as np

from .. import NoPictures


class Window:
    """Shows pictures."""

    def __init__(self, title: str):
        try:
            import tkinter

            self.root = tkinter.Tk()
        except Exception as why:  # no Tk (Debian: python3-tk), or no display
            raise NoPictures(f"render_mode human: no window can be opened, expected python3-tk and a display "
                             f"({why})") from why
        self.root.title(title)
        self.label = tkinter.Label(self.root)
        self.label.pack()

    def show(self, picture: np.ndarray) -> None:
        import tkinter

        height, width, _ = picture.shape
        data = b"P6 %d %d 255 " % (width, height) + picture.tobytes()
        self.image = tkinter.PhotoImage(data=data, format="PPM")
        self.label.configure(image=self.image)
        self.root.update()

    def close(self) -> None:
        self.root.destroy()
