"""A picture of the set entries of a matrix, one pixel per entry."""

import base64
import io

from matplotlib.colors import ListedColormap
from matplotlib.image import imsave

SHADES = ListedColormap(["#00000000", "#3c82c8"])  # other entries are transparent, for light and dark pages


def picture(is_set, description):
    png = io.BytesIO()
    imsave(png, is_set, format="png", cmap=SHADES, vmin=0, vmax=1, metadata={"Software": None})
    height, width = is_set.shape
    return (
        f'<img class="spy" width="{width}" height="{height}" alt="{description}" '
        f'src="data:image/png;base64,{base64.b64encode(png.getvalue()).decode()}"/>'
    )
