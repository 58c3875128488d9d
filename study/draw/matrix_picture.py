"""Which entries of a matrix are set, as a picture of one pixel an entry."""

import base64
import io

from matplotlib.colors import ListedColormap
from matplotlib.image import imsave

SHADES = ListedColormap(["#00000000", "#3c82c8"])  # transparent where not set: for light and dark pages


def picture(is_set, description):
    png = io.BytesIO()
    imsave(png, is_set, format="png", cmap=SHADES, vmin=0, vmax=1, metadata={"Software": None})
    height, width = is_set.shape
    return (
        f'<img class="spy" width="{width}" height="{height}" alt="{description}" '
        f'src="data:image/png;base64,{base64.b64encode(png.getvalue()).decode()}"/>'
    )
