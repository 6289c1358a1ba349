! RAPID Overview, Motion settings: what is in force, and what PP to main and its like reset.
MODULE settings_changed
  PROC main()
    VelSet 50,800;
    AccSet 50,80;
    ConfL\Off;
    SingArea\Wrist;
    TPWrite ValToStr(C_MOTSET.vel.oride)+","+ValToStr(C_MOTSET.vel.max); ! -> 50,800
    TPWrite ValToStr(C_MOTSET.acc.acc)+","+ValToStr(C_MOTSET.acc.ramp); ! -> 50,80
    TPWrite ValToStr(C_MOTSET.conf.lsup)+ValToStr(C_MOTSET.conf.jsup); ! -> FALSETRUE
    TPWrite ValToStr(C_MOTSET.sing.wrist);  ! -> TRUE
    SingArea\Off;
    TPWrite ValToStr(C_MOTSET.sing.wrist)+ValToStr(C_MOTSET.sing.base); ! -> FALSETRUE
    ConfL\On;
    VelSet 100,5000;
    AccSet 100,100;
    AccSet 10,5;
    TPWrite ValToStr(C_MOTSET.acc.acc)+","+ValToStr(C_MOTSET.acc.ramp); ! -> 20,10
    PathAccLim TRUE\AccMax:=4,TRUE\DecelMax:=4;
    WorldAccLim\On:=3.5;
    TPWrite "end";                          ! -> end
  ERROR
    IF ERRNO=ERR_ARGVALERR TPWrite "value";
    TRYNEXT;
  ENDPROC
ENDMODULE
