! RAPID Instructions, SpeedRefresh: an override is between 0 and 100 percent.
MODULE speed_refresh_limits
  PROC main()
    SpeedRefresh 120;
    TPWrite ValToStr(CSpeedOverride());     ! -> 100
    SpeedRefresh -1;
  ERROR
    TPWrite ValToStr(ERRNO=ERR_SPEED_REFRESH_LIM); ! -> TRUE ! -> TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
