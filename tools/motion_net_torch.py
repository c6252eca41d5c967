"""The network of ``recognizer/networks/motion_net.py`` in PyTorch, as ``tools/train_motion_net.py`` trains it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import torch
from torch import nn

from recognizer.networks.motion_net import DILATIONS, FEATURES, STRIDES

CHANNELS, SIDES = (2, 8, 16, 32, 40, 48), (5, 3, 3, 3, 3)  # of the convolutions over space
SEEN, HEAD, TIME = 64, 32, 96  # numbers of a step: of all it sees, of the head; of the convolutions over time
DROPPED = 0.15


class Net(nn.Module):
    """The layers of :class:`recognizer.networks.motion_net.MotionNet` before they are folded, and one that names."""

    def __init__(self, classes: int) -> None:
        super().__init__()
        reads = [c + 3 * (stride == 1) for c, stride in zip(CHANNELS[:-1], STRIDES, strict=True)]
        self.space = nn.ModuleList(
            nn.Sequential(nn.Conv2d(n, out, side, stride, side // 2), nn.BatchNorm2d(out), nn.ReLU())
            for n, out, side, stride in zip(reads, CHANNELS[1:], SIDES, STRIDES, strict=True)
        )
        self.seen, self.head = nn.Linear(CHANNELS[-1] * 20, SEEN), nn.Linear(76, HEAD)
        self.time = nn.ModuleList(
            nn.Sequential(nn.Conv1d(n, TIME, 5, padding=2 * d, dilation=d), nn.BatchNorm1d(TIME), nn.ReLU())
            for n, d in zip((SEEN + HEAD, TIME, TIME), DILATIONS, strict=True)
        )
        self.whole, self.name = nn.Linear(3 * TIME, FEATURES), nn.Linear(FEATURES, classes)

    def forward(
        self, pictures: torch.Tensor, flow: torch.Tensor, head: torch.Tensor, there: torch.Tensor
    ) -> torch.Tensor:
        """Name clips: logits (n, classes)."""
        used = there.flatten()
        maps = pictures
        for layer, stride in zip(self.space, STRIDES, strict=True):
            maps = layer(maps if stride > 1 else torch.cat([maps, flow], 1))
        drop = nn.functional.dropout
        seen = self.seen(drop(maps.flatten(1), DROPPED, self.training)).relu()
        seen = torch.cat([seen, self.head(head).relu()], 1)
        steps = seen.new_zeros(len(used), SEEN + HEAD)
        steps[used] = seen
        mask = there[:, None].to(seen.dtype)
        found = self.time[0](steps.view(*there.shape, -1).transpose(1, 2)) * mask
        for layer in self.time[1:]:
            found = found + layer(found) * mask
        count = mask.sum(2)
        mean = found.sum(2) / count
        highest = (found - 1e4 * (1 - mask)).amax(2)
        spread = (((found - mean[..., None]) * mask).square().sum(2) / count + 1e-4).sqrt()
        whole = self.whole(drop(torch.cat([mean, highest, spread], 1), 2 * DROPPED, self.training)).relu()
        return self.name(drop(whole, DROPPED, self.training))

    def folded(self) -> dict[str, np.ndarray]:
        """Weights as :class:`recognizer.networks.motion_net.Layer` reads them."""
        arrays = {}
        for name, layers in (("space", self.space), ("time", self.time)):
            for k, (convolution, norm, _) in enumerate(layers):
                gain = norm.weight / (norm.running_var + norm.eps).sqrt()
                weights = (convolution.weight.movedim(0, -1) * gain).movedim(0, -2).flatten(0, -2)
                arrays[f"{name}{k}_weights"] = weights
                arrays[f"{name}{k}_offsets"] = (convolution.bias - norm.running_mean) * gain + norm.bias
        # The network reads maps with the channels last.
        seen = self.seen.weight.unflatten(1, (CHANNELS[-1], 20)).transpose(1, 2).flatten(1)
        for name, weights, layer in (
            ("seen", seen, self.seen),
            ("head", self.head.weight, self.head),
            ("whole", self.whole.weight, self.whole),
        ):
            arrays[f"{name}_weights"], arrays[f"{name}_offsets"] = weights.T, layer.bias
        return {name: values.detach().contiguous().numpy().astype(np.float16) for name, values in arrays.items()}

    def begin_with(self, arrays: Mapping[str, np.ndarray], seen: Iterable[Sequence[torch.Tensor]]) -> None:
        """Take over folded weights, all but those of the layer that names, which are not kept.

        What batch normalisation had taken away is measured again on some inputs it has ``seen``, as :meth:`forward`
        takes them, and given back by its own weights, so that the network says what it said.

        Raises:
            KeyError, RuntimeError: the weights are of a network of another shape.
        """
        folded = {name: torch.from_numpy(values.astype(np.float32)) for name, values in arrays.items()}
        norms = []
        with torch.no_grad():
            for name, layers in (("space", self.space), ("time", self.time)):
                for k, (convolution, norm, _) in enumerate(layers):
                    shape = convolution.weight.movedim(0, -1).movedim(0, -2).shape
                    weights = folded[f"{name}{k}_weights"].view(shape).movedim(-2, 0).movedim(-1, 0)
                    convolution.weight.copy_(weights)
                    convolution.bias.copy_(folded[f"{name}{k}_offsets"])
                    norm.running_var.fill_(1 - norm.eps)
                    norms.append(norm)
            places = folded["seen_weights"].T.unflatten(1, (20, CHANNELS[-1])).transpose(1, 2).flatten(1)
            for layer, name, weights in (
                (self.seen, "seen", places),
                (self.head, "head", folded["head_weights"].T),
                (self.whole, "whole", folded["whole_weights"].T),
            ):
                layer.weight.copy_(weights)
                layer.bias.copy_(folded[f"{name}_offsets"])
            self.eval()
            sums = {norm: torch.zeros(3, norm.num_features, dtype=torch.float64) for norm in norms}

            def add(norm: nn.Module, inputs: tuple[torch.Tensor], _: torch.Tensor) -> None:
                values = inputs[0].transpose(0, 1).flatten(1).double()
                sums[norm] += torch.stack(
                    [torch.ones(len(values)) * values[0].numel(), values.sum(1), values.square().sum(1)]
                )

            hooks = [norm.register_forward_hook(add) for norm in norms]
            for inputs in seen:
                self(*inputs)
            for hook in hooks:
                hook.remove()
            for norm, (count, total, squares) in sums.items():
                mean = total / count
                norm.running_mean.copy_(mean)
                norm.running_var.copy_(squares / count - mean.square())
                norm.weight.copy_((norm.running_var + norm.eps).sqrt())
                norm.bias.copy_(norm.running_mean)
