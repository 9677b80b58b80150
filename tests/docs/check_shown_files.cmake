# Fails when the text of one of FILES does not stand in PAGE.
file(READ "${PAGE}" page)
foreach(shown IN LISTS FILES)
    file(READ "${shown}" text)
    string(FIND "${page}" "```cpp\n${text}```\n" place)
    if(place EQUAL -1)
        message(SEND_ERROR "${shown} is not what ${PAGE} shows")
    endif()
endforeach()
