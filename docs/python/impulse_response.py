"""The impulse response of a classic room, its delay spread and its bandwidth."""

import sys

import matplotlib.pyplot as plt
import shelfbeam as sb

pd = {"type": "pd", "ignore": ["label_in_mid_air"]}
room = sb.Store(
    {
        "room": {"size": [5, 5, 3], "floor": "floor", "ceiling": "wall", "walls": "wall"},
        "materials": {"wall": sb.material(0.8), "floor": sb.material(0.3)},
        "label_types": {"pd": {"threshold": 0.01}},
        "labels": [
            {"id": "below", "position": [2.5, 2.5, 0.85], "normal": [0, 0, 1], **pd},
            {"id": "corner", "position": [0.5, 0.5, 0.85], "normal": [0, 0, 1], **pd},
        ],
    }
)
led = room.add_emitter(sb.Emitter.lambertian(flux=1))
room.document["transceivers"] = {"list": [{"id": "led", "position": [2.5, 2.5, 3], "type": led}]}
response = sb.impulse_response(room, step=0.1, max_bounces=10, samples=200000)

figure, axes = plt.subplots(layout="constrained")
for row, name in enumerate(response.labels["id"]):
    spread, width = response.delay_spread_ns[row, 0], response.bandwidth_MHz[row, 0]
    print(f"{name}: {response.signal[row, 0]:.4f} W/m2, delay spread {spread:.2f} ns, bandwidth {width:.1f} MHz")
    axes.semilogy(response.time_ns, response.response[row, 0], label=name)
axes.set(xlim=(0, 80), xlabel="time (ns)", ylabel="signal per bin (W/m²)")
axes.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "impulse_response.png", dpi=150)
