! RAPID Functions, StrPart: errors of the string functions, and the examples.
MODULE texts_by_position
  PROC main()
    VAR string s;
    VAR num n;
    TPWrite StrPart("Robotics",1,5);        ! -> Robot
    TPWrite ValToStr(StrFind("Robotics",1,"aeiou")); ! -> 2
    TPWrite ValToStr(StrFind("Robotics",1,"aeiou"\NotInSet)); ! -> 1
    TPWrite ValToStr(StrFind("IRB 6400",1,STR_DIGIT)); ! -> 5
    TPWrite ValToStr(StrMatch("Robotics",1,"bo")); ! -> 3
    TPWrite ValToStr(StrMatch("Robotics",1,"xx")); ! -> 9
    TPWrite StrMap("Robotics","aeiou","AEIOU"); ! -> RObOtIcs
    TPWrite StrMap("Robotics",STR_LOWER,STR_UPPER); ! -> ROBOTICS
    TPWrite ValToStr(StrMemb("Robotics",2,"aeiou")); ! -> TRUE
    TPWrite ValToStr(StrOrder("FIRST","SECOND",STR_UPPER)); ! -> TRUE
    TPWrite ValToStr(StrLen(""));           ! -> 0
    TPWrite DecToHex("99999999")+HexToDec("5F5E0FF"); ! -> 5F5E0FF99999999
    TPWrite NumToStr(0.38521,3)+" "+NumToStr(0.38521,2\Exp); ! -> 0.385 3.85E-01
    TPWrite ByteToStr(122)+ByteToStr(122\Hex)+" "+ByteToStr(122\Okt)+" "+ByteToStr(122\Bin)+ByteToStr(122\Char); ! -> 1227A 172 01111010z
    TPWrite ValToStr(StrToByte("7A"\Hex))+ValToStr(StrToByte("z"\Char)); ! -> 122122
    s:=StrPart("Robotics",9,1);
    s:=StrPart("Robotics",3,7);
    n:=StrFind("Robotics",10,"a");
    n:=StrToByte("256");
    s:=StrMap("a","ab","c");
    n:=StrMatch("Robotics",1,"");
    TPWrite "end";                          ! -> end
  ERROR
    IF ERRNO=ERR_STRTOOLNG TPWrite "long";
    IF ERRNO=ERR_ARGVALERR TPWrite "value"; ! -> value ! -> value ! -> value ! -> value ! -> value
    TRYNEXT;
  ENDPROC
ENDMODULE
