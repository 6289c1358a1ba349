MODULE strings
  CONST string quoted:="He said ""go""!";
  CONST string path:="C:\\temp\\a.txt";
  CONST string ending:="\0D\0A";
  VAR string s:="";
  VAR num found;
  PROC main()
    s:=quoted+path+ending;
    found:=StrMatch(s,1,"go")+StrFind(s,1,STR_DIGIT)+StrLen(s);
    IF StrMemb(s,1,STR_UPPER) AND StrOrder("a","b",STR_UPPER) s:=StrMap(s,STR_LOWER,STR_UPPER);
    s:=ByteToStr(StrToByte("A"\Char)\Hex)+DecToHex("255")+StrPart(path,1,3);
    TPWrite s\Num:=found; ! "quotes" ! in a comment
  ENDPROC
ENDMODULE
