"""What is known of the one sound of Mandarin that the Common Phoneme Set has no class for.

ü is said with the tongue of i and the lips of u: rounded and pushed forward, with the
smallest opening of all vowels and the teeth nearly shut. It is a little less narrow than
u, whose lips the low back of the tongue helps to draw in, and the lips flare a little as
in sh. The tongue lies low behind the lower teeth: no tongue pose shows it.
"""

from __future__ import annotations

from dataclasses import replace

from tools.english.knowledge import SOUNDS as ENGLISH
from tools.sounds import Sound, vowel

_Z = ENGLISH["z"]

#: Beside ü the class of s is always j, q or x, whose lips are round from their beginning
#: (去 qù): they let more of the rounding through than an English s, and nothing spread.
SOUNDS: dict[str, Sound] = {
    **ENGLISH,
    "yu": vowel(open=0.03, W=0.86, ShCh=0.14),
    "z": replace(
        _Z,
        first={**_Z.first, "wide": 0.0},
        lets_through={**_Z.lets_through, "W": 0.75, "ShCh": 0.5},
    ),
}

#: A Chinese word for each pair that has a common one, within a syllable or across two.
WORDS: dict[tuple[str, str], str] = {
    ("sil", "yu"): "鱼 yú", ("yu", "sil"): "女 nǚ", ("yu", "yu"): "寓于 yùyú",
    ("d", "yu"): "女 nǚ", ("l", "yu"): "绿 lǜ", ("z", "yu"): "去 qù",
    ("aa", "yu"): "大雨 dàyǔ", ("ah", "yu"): "德育 déyù", ("ao", "yu"): "国语 guóyǔ",
    ("eh", "yu"): "节育 jiéyù", ("er", "yu"): "日语 rìyǔ", ("ih", "yu"): "鲤鱼 lǐyú",
    ("w", "yu"): "五月 wǔyuè", ("ow", "yu"): "鱿鱼 yóuyú", ("aw", "yu"): "教育 jiàoyù",
    ("ay", "yu"): "待遇 dàiyù",
    ("yu", "d"): "云 yún", ("yu", "eh"): "月 yuè", ("yu", "w"): "用 yòng",
    ("yu", "ih"): "语义 yǔyì", ("yu", "er"): "女儿 nǚ'ér", ("yu", "z"): "语序 yǔxù",
    ("yu", "sh"): "雨声 yǔshēng", ("yu", "kg"): "女孩 nǚhái", ("yu", "bmp"): "语病 yǔbìng",
    ("yu", "f"): "语法 yǔfǎ", ("yu", "l"): "语录 yǔlù",
}  # fmt: skip
